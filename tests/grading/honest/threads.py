# Odd: works in threads, and leaves one running.
# Earns: 100
# %%
import threading
import time
from concurrent.futures import ThreadPoolExecutor

threading.Thread(target=lambda: time.sleep(1000), daemon=True).start()
# %% solution
# %%
serial = gyrostat_rate


def gyrostat_rate(*arguments):
    with ThreadPoolExecutor(2) as pool:
        return pool.submit(serial, *arguments).result()
