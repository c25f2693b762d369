"""Child processes that end with the script, also if it ends with an error."""
import atexit
import subprocess

_children = []


def start(command, **options):
    """As subprocess.Popen."""
    child = subprocess.Popen(command, **options)
    _children.append(child)
    return child


@atexit.register
def _kill_all():
    for child in _children:
        if child.poll() is None:
            child.kill()
            child.wait()
