"""Two pipes to a worker, with a limit on the time and the length of everything. A worker that floods, drips,
stops reading or dies costs the grader its time limit at most."""

import os
import select
import time

CHUNK = 1 << 16


class Gone(Exception):
    """No answer came. `late` tells a worker that took too long from one that ended or sent rubbish."""

    def __init__(self, message, late=False):
        super().__init__(message)
        self.late = late


class Wire:
    """The grader's ends. `theirs` are the worker's: to be handed over, then `release`d."""

    def __init__(self):
        reading, self.outgoing = os.pipe()
        self.incoming, writing = os.pipe()
        self.theirs, self.buffer = (reading, writing), bytearray()
        os.set_blocking(self.outgoing, False)
        os.set_blocking(self.incoming, False)

    def release(self):
        for number in self.theirs:
            os.close(number)
        self.theirs = ()

    def close(self):
        self.release()
        os.close(self.outgoing)
        os.close(self.incoming)

    def send(self, data, seconds):
        deadline, rest = time.monotonic() + seconds, memoryview(data)
        while rest:
            _wait(self.outgoing, select.POLLOUT, deadline, seconds)
            try:
                rest = rest[os.write(self.outgoing, rest[:CHUNK]) :]
            except BlockingIOError:
                continue
            except OSError:
                raise Gone("it ended") from None

    def line(self, seconds, longest):
        """The next line that comes, as bytes."""
        deadline, looked = time.monotonic() + seconds, 0
        while (end := self.buffer.find(b"\n", looked)) < 0:
            looked = len(self.buffer)
            if looked > longest:
                raise Gone(f"it sent more than {longest:,} bytes")
            _wait(self.incoming, select.POLLIN, deadline, seconds)
            try:
                data = os.read(self.incoming, CHUNK)
            except BlockingIOError:
                continue
            if not data:
                raise Gone("it ended")
            self.buffer += data
        line = bytes(self.buffer[:end])
        del self.buffer[: end + 1]
        return line


def _wait(number, event, deadline, seconds):
    left = deadline - time.monotonic()
    poller = select.poll()
    poller.register(number, event)
    if left <= 0 or not poller.poll(left * 1000):
        raise Gone(f"it took longer than {seconds:.0f} s", late=True)
