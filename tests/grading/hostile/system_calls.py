# Attack: one call after the other that a student needs not.
# %%
import ctypes
import errno

libc = ctypes.CDLL(None, use_errno=True)
CALLS = {"ptrace": 101, "process_vm_readv": 310, "process_vm_writev": 311, "io_uring_setup": 425, "userfaultfd": 323,
         "keyctl": 250, "add_key": 248, "bpf": 321, "perf_event_open": 298, "unshare": 272, "setns": 308,
         "mount": 165, "umount2": 166, "pivot_root": 155, "chroot": 161, "open_by_handle_at": 304,
         "name_to_handle_at": 303, "pidfd_open": 434, "pidfd_getfd": 438, "memfd_create": 319, "memfd_secret": 447,
         "seccomp": 317, "landlock_restrict_self": 446, "personality": 135, "setpriority": 141, "setsid": 112,
         "setpgid": 109, "execve": 59, "execveat": 322, "shmget": 29, "msgget": 68, "semget": 64, "mq_open": 240,
         "fsopen": 430, "mount_setattr": 442, "move_mount": 429, "kexec_load": 246, "init_module": 175, "reboot": 169,
         "swapon": 167, "sethostname": 170, "inotify_init": 253, "fanotify_init": 300, "sync": 162, "splice": 275,
         "vmsplice": 278, "sched_setscheduler": 144, "ioprio_set": 251, "migrate_pages": 256, "setuid": 105,
         "capset": 126, "iopl": 172, "quotactl": 179, "clock_settime": 227, "socket": 41, "connect": 42, "bind": 49}


def attack(*arguments):
    for name, number in CALLS.items():
        ctypes.set_errno(0)
        result = libc.syscall(ctypes.c_long(number), *([ctypes.c_long(0)] * 6))
        if result >= 0 or ctypes.get_errno() not in (errno.EPERM, errno.ENOSYS, errno.EACCES):
            raise RuntimeError(f"BREACH {name}: {result} {ctypes.get_errno()}")
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
