"""Waits for what other processes do."""
import time

# Ends a script that would wait forever. Nothing that is waited for takes nearly as long, so no result depends on the
# speed of the machine.
HANG_SECONDS = 300


def wait_for(condition, what, pause=0.02):
    """Seconds until the condition holds. Ends the script if it never does: `what` does not happen."""
    start = time.monotonic()
    while not condition():
        if time.monotonic() - start > HANG_SECONDS:
            raise SystemExit(f"failed: {what} does not happen")
        time.sleep(pause)
    return time.monotonic() - start
