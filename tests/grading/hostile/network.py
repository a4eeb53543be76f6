# Attack: asks for the answers over the network, and listens.
# %%
import socket


def attack(*arguments):
    for family in (socket.AF_INET, socket.AF_INET6, socket.AF_UNIX, 16, 17, 38, 40):
        for kind in (socket.SOCK_STREAM, socket.SOCK_DGRAM, socket.SOCK_RAW):
            try:
                socket.socket(family, kind)
            except OSError:
                continue
            raise RuntimeError(f"BREACH a socket {family} {kind}")
    one, _ = socket.socketpair()
    for address in ("/run/systemd/notify", "\0bus", "/var/run/docker.sock"):
        try:
            one.sendto(b"x", address)
        except OSError:
            continue
        raise RuntimeError("BREACH sent to " + address)
    try:
        socket.socketpair(socket.AF_UNIX, socket.SOCK_DGRAM)
    except OSError:
        return 0.0
    raise RuntimeError("BREACH datagrams")


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
