# Attack: links to files outside, and devices.
# %%
import os


def attack(*arguments):
    for target in ("/etc/passwd", "/", "/proc/1"):
        for make in (os.symlink, os.link):
            try:
                make(target, "link")
                open("link" if target != "/" else "link/etc/shadow").read()
            except OSError:
                continue
            raise RuntimeError("BREACH " + target)
    os.mknod("device", 0o020666, os.makedev(1, 1))


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
