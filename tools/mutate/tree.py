"""The copy of the sources that changes are made in."""

import hashlib
import os
import shutil
import subprocess

from . import BadInput
from .places import folder_of

NOT_TESTED = ("docs/", "packaging/", "python/", "tools/")  # by the test programs


class Tree:
    def __init__(self, source, root):
        self.source = source  # the checkout
        self.root = root  # the copy

    def update(self):
        """Makes the copy equal to the checkout without files that git ignores, and returns a digest of the files that the
        test programs are built from or read. Equal files keep their time, so that Ninja builds only changes."""
        listing = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                                 cwd=self.source, capture_output=True, text=True, check=False)
        if listing.returncode != 0:
            raise BadInput(f"{self.source}: git ls-files: {listing.stderr.strip()}")
        output = self.root.parent.resolve()
        names = {name for name in listing.stdout.split("\0") if name and os.path.lexists(self.source / name)
                 and not (self.source / name).resolve().is_relative_to(output)}
        digest = hashlib.sha256()
        for name in sorted(names):
            content = copy_if_different(self.source / name, self.root / name)
            if not name.startswith(NOT_TESTED):
                digest.update(f"{name}\0{len(content)}\0".encode() + content)
        for path in [path for path in self.root.rglob("*") if not path.is_dir() or path.is_symlink()]:
            if path.relative_to(self.root).as_posix() not in names:
                path.unlink()
        return digest.hexdigest()[:16]


def copy_if_different(source, target):
    """Copies the file if it differs; returns the content."""
    if source.is_dir():
        raise BadInput(f"{source}: a repository within the repository cannot be copied")
    content, mode = source.read_bytes(), source.stat().st_mode
    if target.is_file() and target.read_bytes() == content and target.stat().st_mode == mode:
        return content
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(content)
    shutil.copymode(source, target)
    return content


def digest_of(root, modules):
    """Digest of the modules' sources: if it is unchanged, so are the places."""
    digest = hashlib.sha256()
    for module in modules:
        for path in sorted(folder_of(root, module).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                digest.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]
