# Odd: lists, tuples, float32 where it is exact enough, 0-d arrays, subclasses of ndarray.
# Earns: 100
# %% solution
# %%
array_rate, array_plate, array_march, array_flip = body_rate, plate, march, flip_time


class Vector(np.ndarray):
    pass


def body_rate(q, omega):
    return np.asarray(array_rate(q, omega)).view(Vector)


def plate(outline, holes, density):
    mass, centre, inertia = array_plate(outline, holes, density)
    return [np.array(mass), [float(x) for x in centre], np.float64(inertia)]


def march(*arguments):
    return array_march(*arguments).view(Vector)


def flip_time(*arguments):
    return np.asarray(array_flip(*arguments))
