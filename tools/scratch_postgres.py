"""A temporary PostgreSQL server in a folder, for tests and benchmarks: started, stopped, killed, removed.

    with ScratchPostgres() as server:
        subprocess.run([program, "generate", "--radius", "8", "--world", server.url()])

PostgreSQL does not run as root: the user postgres then owns the folder. Without fsync data survive kills but not a
power failure; `durable=True` is for measurements.
"""

import glob
import os
import pwd
import shutil
import socket
import subprocess
import tempfile


def programs():
    found = sorted(glob.glob("/usr/lib/postgresql/*/bin/initdb"))
    if not found:
        raise SystemExit("PostgreSQL is not installed: apt-get install postgresql-15")
    return os.path.dirname(found[-1])


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class ScratchPostgres:
    def __init__(self, durable=False, settings=()):
        self.folder = tempfile.mkdtemp(prefix="terrane_postgres_")
        self.port = free_port()
        self.settings = ["listen_addresses=127.0.0.1", "max_connections=100", f"fsync={'on' if durable else 'off'}",
                         *settings]
        os.chmod(self.folder, 0o755)
        if os.geteuid() == 0:
            user = pwd.getpwnam("postgres")
            os.chown(self.folder, user.pw_uid, user.pw_gid)
        self._run("initdb", "-U", "postgres", "-E", "UTF8", "--no-locale", "--no-sync", "--auth=trust")
        self.start()

    def _run(self, name, *arguments, check=True):
        as_user = (["setpriv", "--reuid", "postgres", "--regid", "postgres", "--clear-groups", "--"]
                   if os.geteuid() == 0 else [])
        # The server that pg_ctl starts must not keep the pipes of this process open.
        return subprocess.run([*as_user, f"{programs()}/{name}", "-D", f"{self.folder}/data", *arguments], check=check,
                              stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def start(self):
        options = " ".join(f"-c {setting}" for setting in self.settings)
        self._run("pg_ctl", "-l", f"{self.folder}/log", "-w", "-o", f"-k {self.folder} -p {self.port} {options}",
                  "start")

    def stop(self):
        self._run("pg_ctl", "-m", "fast", "-w", "stop")

    def kill(self):
        self._run("pg_ctl", "-m", "immediate", "-w", "stop", check=False)

    def url(self, schema="terrane"):
        return f"postgresql://postgres@127.0.0.1:{self.port}/postgres?schema={schema}"

    def query(self, sql):
        """The output of psql: a row per line, columns separated by |."""
        return subprocess.run([*self.psql(), "-c", sql], check=True, capture_output=True, text=True).stdout.strip()

    def psql(self):
        return ["psql", "-X", "-q", "-A", "-t", f"postgresql://postgres@127.0.0.1:{self.port}/postgres"]

    def close(self):
        self.kill()
        shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
