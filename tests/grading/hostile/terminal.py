# Attack: types into the grader's terminal.
# %%
import fcntl
import os
import termios


def attack(*arguments):
    for number in range(10):
        for command in (termios.TIOCSTI, 0x541C, termios.TIOCSCTTY, 0x5422):
            try:
                fcntl.ioctl(number, command, b"\n")
            except OSError:
                continue
            raise RuntimeError("BREACH terminal")
    try:
        os.open("/dev/tty", os.O_RDWR)
    except OSError:
        return 0.0
    raise RuntimeError("BREACH /dev/tty")


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
