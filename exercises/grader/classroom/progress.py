"""How far it is and how long it takes: a line that renews itself; away from a terminal one line a tenth."""

import sys
import time


class Progress:
    def __init__(self, total, what, stream=None):
        self.total, self.what, self.done, self.notes = total, what, 0, {}
        self.stream = stream or sys.stderr
        self.began, self.shown, self.tenth = time.monotonic(), 0.0, 0

    def step(self, kind="ok"):
        """One more is done; kinds other than ok are counted on the line."""
        self.done += 1
        if kind != "ok":
            self.notes[kind] = self.notes.get(kind, 0) + 1
        now, last = time.monotonic(), self.done == self.total
        if self.stream.isatty():
            if last or now - self.shown > 0.2:
                self.shown = now
                print(f"\r\033[K{self.line()}", end="\n" if last else "", file=self.stream, flush=True)
        elif last or self.done * 10 // self.total > self.tenth:
            self.tenth = self.done * 10 // self.total
            print(self.line(), file=self.stream, flush=True)

    def line(self):
        spent = time.monotonic() - self.began
        left = spent / self.done * (self.total - self.done) if self.done else 0
        blocks = self.done * 24 // self.total
        notes = "".join(f", {count} {kind}" for kind, count in sorted(self.notes.items()))
        end = f"took {duration(spent)}" if self.done == self.total else f"{duration(left)} left"
        return f"[{'#' * blocks}{'.' * (24 - blocks)}] {self.done} of {self.total} {self.what}{notes}; {end}"


def duration(seconds):
    minutes, seconds = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return (
        f"{hours} h {minutes:02} min"
        if hours
        else f"{minutes} min {seconds:02} s"
        if minutes
        else f"{seconds} s"
    )
