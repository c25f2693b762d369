"""Faults during a soak, one at a time, each repaired after a moment."""
import itertools
import signal
import time

DOWN_SECONDS = 5


class Events:
    def __init__(self, soak, pause):
        self.soak, self.pause = soak, pause
        self.next = time.monotonic() + pause
        self.turn = itertools.cycle((lambda: self.kill_server(0), self.stop_database, lambda: self.kill_server(1),
                                     self.kill_database, self.kill_window))

    def update(self):
        if time.monotonic() >= self.next and not self.soak.bots.are_joining():
            next(self.turn)()
            self.next = time.monotonic() + self.pause

    def kill_server(self, number):
        port = self.soak.servers[number].port
        self.soak.record.event("server killed", server=number + 1)
        self.soak.servers[number].stop(signal.SIGKILL)
        time.sleep(DOWN_SECONDS)
        self.soak.servers[number] = self.soak.start_server(number, port)

    def stop_database(self):
        self.soak.record.event("database stopped")
        self.soak.postgres.stop()
        time.sleep(DOWN_SECONDS)
        self.soak.postgres.start()

    def kill_database(self):
        self.soak.record.event("database killed")
        self.soak.postgres.kill()
        time.sleep(DOWN_SECONDS)
        self.soak.postgres.start()

    def kill_window(self):
        self.soak.record.event("window killed", window=2)
        old = self.soak.windows[1]
        old.kill()
        time.sleep(DOWN_SECONDS)
        self.soak.windows[1] = self.soak.start_window(1, old.seed + 1)
