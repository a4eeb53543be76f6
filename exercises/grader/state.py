"""What a question changes in a student's things is put back, so that no question can tell of another.

In class each check is put to a fresh process. In a notebook, and in the shell, the process goes on: there a
counter, a list that grows or a remembered value would make the next check's answers other ones. So names,
containers, arrays, defaults, attributes and random generators are as they were once a question is answered.
"""

import collections
import contextlib
import functools
import random
import types

import numpy as np

MOST_THINGS, MOST_BYTES = 50_000, 50_000_000  # looked at; of arrays copied
UNCHANGING = {type(None), bool, int, float, complex, str, bytes, types.ModuleType, types.BuiltinFunctionType}


@contextlib.contextmanager
def put_back(names):
    """All that can be reached from the dictionary `names` is afterwards as it was before."""
    undo = _remember(names)
    try:
        yield
    finally:
        for function, *arguments in undo:
            with contextlib.suppress(Exception):  # an attribute that cannot be set again, a class that minds
                function(*arguments)


def _remember(names):
    """What is to be done afterwards: functions with their arguments."""
    undo, seen, waiting, room = [], {}, [names], MOST_BYTES
    while waiting and len(seen) < MOST_THINGS:
        thing = waiting.pop()
        if type(thing) in UNCHANGING or id(thing) in seen:
            continue
        seen[id(thing)] = thing
        with contextlib.suppress(Exception):  # a thing that cannot even be looked at
            if issubclass(type(thing), np.ndarray):
                room -= thing.nbytes
                if room > 0 and thing.flags.writeable:
                    undo.append((np.copyto, thing, thing.copy()))
            steps, inside = _of(thing, names)
            undo += steps
            waiting += inside
    return undo


def _of(thing, names):
    """(what is to be done for this thing, the things in it)."""
    kind = type(thing)
    if issubclass(kind, dict):
        return [(_put_items, thing, dict(dict.items(thing)))], dict.values(thing)
    if issubclass(kind, list):
        return [(list.__setitem__, thing, slice(None), list.copy(thing))], list.copy(thing)
    if issubclass(kind, set):
        return [(_put_members, thing, set.copy(thing))], ()
    if issubclass(kind, collections.deque):
        return [(_put_queue, thing, list(thing))], list(thing)
    if issubclass(kind, tuple):
        return [], tuple.__iter__(thing)
    if kind is types.FunctionType and thing.__globals__ is names:
        cells = [(cell, cell.cell_contents) for cell in thing.__closure__ or () if _is_full(cell)]
        inside = [thing.__defaults__, thing.__kwdefaults__, thing.__dict__, *(value for _, value in cells)]
        return [(setattr, cell, "cell_contents", value) for cell, value in cells], inside
    if kind is functools.partial:
        return [], [thing.func, thing.args, thing.keywords]
    if kind is functools._lru_cache_wrapper:
        return [(thing.cache_clear,)], [thing.__wrapped__]
    if kind is np.random.Generator:
        return [(setattr, thing.bit_generator, "state", thing.bit_generator.state)], ()
    if kind is random.Random or kind is np.random.RandomState:
        read, write = ("getstate", "setstate") if kind is random.Random else ("get_state", "set_state")
        return [(getattr(thing, write), getattr(thing, read)())], ()
    if issubclass(kind, type) and thing.__module__ == names.get("__name__"):
        return [(_put_attributes, thing, dict(vars(thing)))], list(vars(thing).values())
    if kind.__module__ == names.get("__name__") and hasattr(thing, "__dict__"):
        return [], [vars(thing)]
    return [], ()


def _is_full(cell):
    try:
        return cell.cell_contents is not None
    except ValueError:
        return False


def _put_items(thing, before):
    for key in [key for key in dict.keys(thing) if key not in before]:
        dict.__delitem__(thing, key)
    for key, value in before.items():
        if key not in thing or dict.__getitem__(thing, key) is not value:
            dict.__setitem__(thing, key, value)


def _put_members(thing, before):
    set.intersection_update(thing, before)
    set.update(thing, before)


def _put_queue(thing, before):
    thing.clear()
    thing.extend(before)


def _put_attributes(thing, before):
    for name in [name for name in vars(thing) if name not in before]:
        delattr(thing, name)
    for name, value in before.items():
        if vars(thing).get(name) is not value:
            setattr(thing, name, value)
