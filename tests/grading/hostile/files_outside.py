# Attack: reads and writes what lies about on the machine.
# %%
import os


def attack(*arguments):
    for path in ("/etc/passwd", "/etc/shadow", "/etc/hostname", "/var/log", "/home", "/root/.ssh", "/sys/kernel",
                 "/run", "/dev/tty", "/dev/mem", "/dev/kmsg", "/dev/ptmx", "/dev/fuse", "/bin/sh", "/usr/bin"):
        for look in (lambda name: open(name).read(10), os.listdir):
            try:
                look(path)
            except OSError:
                continue
            raise RuntimeError("BREACH read " + path)
    for folder in ("/", "/tmp", "/var/tmp", "/dev", "/dev/shm", "/usr/lib", "/course", os.path.dirname(os.__file__)):
        try:
            open(folder + "/written_by_a_student", "w").close()
        except OSError:
            continue
        raise RuntimeError("BREACH wrote to " + folder)
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
