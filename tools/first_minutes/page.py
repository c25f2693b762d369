"""A page of docs/start, and a shell in which its commands run."""
import contextlib
import os
import re
import subprocess
import sys
import time

LONGEST_STEP = 3600  # seconds


class PageError(Exception):
    """A step does not do what the page says."""


class Shell:
    """A shell that keeps its folder and its variables from command to command."""

    def __init__(self, folder, home):
        environment = {name: value for name, value in os.environ.items() if not name.startswith("XDG_")}
        self.environment = {**environment, "HOME": str(home)}
        self.process = subprocess.Popen(["bash"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        text=True, cwd=folder, env=self.environment)

    def run(self, command):
        """Returns exit code and output."""
        self.process.stdin.write(f"{command}\necho \"end of command $?\"\n")
        self.process.stdin.flush()
        lines = []
        for line in self.process.stdout:
            if end := re.fullmatch(r"(.*)end of command (\d+)\n", line):
                return int(end[2]), "".join(lines) + end[1]
            lines.append(line)
        raise PageError(f"the shell ended in {command}")

    def close(self):
        self.process.stdin.close()
        self.process.wait(60)


class Page:
    def __init__(self, name, source, home):
        self.name, self.source, self.home = name, source, home
        self.text = (source / "docs" / "start" / f"{name}.md").read_text(encoding="utf-8")
        self.times = {}  # seconds by step
        self.output = ""
        self.shell = Shell(source, home)

    def close(self):
        self.shell.close()

    @contextlib.contextmanager
    def step(self, number, upto=None):
        """Measures a step, named by its heading; a step may have several parts."""
        headings = dict(re.findall(r"^## (\d+)\. (.*)$", self.text, re.MULTILINE))
        names = [f"{k}. {headings[str(k)]}" for k in range(number, (upto or number) + 1)]
        name = "; ".join(names)
        print(f"{self.name}: {name}", file=sys.stderr, flush=True)
        start = time.monotonic()
        yield
        self.times[name] = self.times.get(name, 0) + time.monotonic() - start

    def quoted(self, text):
        """The text, which must be in the page."""
        if " ".join(text.split()) not in " ".join(self.text.split()):
            raise PageError(f"the page does not have: {text}")
        return text

    def run(self, command):
        """Runs commands of the page, which must succeed."""
        self.do(self.quoted(command))

    def do(self, command):
        """Runs commands, each in a line, that the page describes in words."""
        self.output = ""
        for line in command.splitlines():
            code, output = self.shell.run(line)
            self.output += output
            if code != 0:
                raise PageError(f"{line.strip()}: exit code {code}: {output[-2000:]}")

    def prints(self, *lines):
        """The last output must have these lines of the page; … stands for any text."""
        for line in lines:
            pattern = re.escape(self.quoted(line)).replace("…", ".*")
            if not re.search(pattern, self.output):
                raise PageError(f"not printed: {line}; but: {self.output[-2000:]}")

    def code(self, language, number=0):
        """A block of code of the page."""
        return re.findall(rf"^```{language}\n(.*?)^```", self.text, re.MULTILINE | re.DOTALL)[number]

    def write(self, name, text, mode="w"):
        """Writes a file in the shell's folder, or appends to it."""
        folder = self.shell.run("pwd")[1].strip()
        with open(f"{folder}/{name}", mode, encoding="utf-8") as file:
            file.write(text)

    def replace(self, name, old, new):
        """Replaces text in a file of the shell's folder, which must have it once."""
        folder = self.shell.run("pwd")[1].strip()
        with open(f"{folder}/{name}", encoding="utf-8") as file:
            text = file.read()
        if text.count(old) != 1:
            raise PageError(f"{name} has {old} {text.count(old)} times")
        self.write(name, text.replace(old, new))


def wait_for(condition, what, seconds=LONGEST_STEP / 10):
    """Returns the result of the condition once it is true."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if result := condition():
            return result
        time.sleep(0.1)
    raise PageError(f"after {seconds:.0f} s: {what}")
