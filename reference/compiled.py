"""Compile the loops: Numba where it is there, the same plain Python where it isn't.

The reference is written as plain Python functions over arrays. ``@compiled`` hands such a function to Numba;
without Numba, or with the environment variable ``REFERENCE_COMPILED=0``, it stays the function it was, so
that a student can step through it. Both give the same numbers, to rounding.

Some functions take other functions: an integrator takes the force, a run takes the integrator's step. Numba
can't keep such a call in its cache on disk. ``bind(rk4, force)`` therefore fixes the leading function
arguments once, before compiling: what Numba sees is an ordinary function of arrays, which it caches and
inlines.

What was compiled is kept on disk: see ``code_cache``.

Serves every slide from S4 and S9 on; lectures/02_equation_of_motion.md.
"""

import ast
import functools
import hashlib
import inspect
import os
import textwrap

from .code_cache import Place, code_folder

try:
    import numba
except ImportError:  # the course runs without Numba, only slower
    numba = None

COMPILED = numba is not None and os.environ.get("REFERENCE_COMPILED", "1") != "0"


def compiled(function=None, *, reorder=False, door=True):
    """Compile a function with Numba on its first call, and cache it; without Numba, the function itself.

    Division by zero gives inf or nan, as NumPy does, in both forms. Functions are inlined into their callers:
    without that, passing a tuple of arrays costs more than the physics, since Numba counts the references to
    each array. For the same reason kernels don't index a tuple by a variable: that could raise, and on the
    path of an exception the counting can't be optimised away (measured: 27 ns a step became 870).
    ``@compiled(reorder=True)`` lets a sum be taken in another order, several terms at a time; the last digits
    may then differ from those of the plain form. door=False: only compiled functions call it (see ``inner``).
    """
    if function is None:
        return functools.partial(compiled, reorder=reorder, door=door)
    order = {"fastmath": {"reassoc"}} if reorder else {}
    return _compile(function, no_cpython_wrapper=not door, **order) if COMPILED else function


def lean(function):
    """Like ``compiled``, for a function that makes no array: it doesn't count the references to those it has.

    That is what makes loops over tuples of many arrays slow: calls within a loop in which something branches
    count each array up and down (measured: 9 ns a turn instead of 1,480, and a quarter of the compile time).
    What would make an array is refused when it is compiled.
    """
    return _compile(function, _nrt=False) if COMPILED else function


def inner(function):
    """Like ``lean``, for what only compiled functions call: no door to Python, which takes long to compile.

    Python can call its ``plain`` form.
    """
    return _compile(function, _nrt=False, no_cpython_wrapper=True) if COMPILED else function


def inner_apart(function):
    """As ``inner``, but called, not inlined: for long loops, which would make each of their callers long."""
    return (
        _compile(function, _nrt=False, no_cpython_wrapper=True, forceinline=False) if COMPILED else function
    )


def _compile(function, *with_functions, **options):
    modules = tuple(dict.fromkeys(m for one in (function, *with_functions) for m in _made_from(one)))
    folder = code_folder(*modules)
    options = {"cache": folder is not None, "error_model": "numpy", "forceinline": True} | options
    Place.folder, before = folder, numba.config.CACHE_LOCATOR_CLASSES
    numba.config.CACHE_LOCATOR_CLASSES = f"{Place.__module__}.{Place.__name__}"
    try:
        compiled_function = _for_any_value(numba.njit(function, **options))
    finally:
        numba.config.CACHE_LOCATOR_CLASSES = before
    compiled_function.made_from = modules
    return compiled_function


def _made_from(function):
    """The modules that a function was made from: its own, and those of the functions bound to it."""
    return getattr(function, "made_from", (plain(function).__module__,))


def _for_any_value(dispatcher):
    """Numba would compile a function again for each number that stands in a call, f(x, 0) and f(x, 1)."""
    template = dispatcher.get_call_template

    def get_call_template(args, kws):
        any_value = numba.types.unliteral
        return template([any_value(arg) for arg in args], {name: any_value(arg) for name, arg in kws.items()})

    dispatcher.get_call_template = get_call_template
    return dispatcher


def merged(function):
    """As ``lean``, for a function called from one place: Numba puts its source there before it compiles.

    So it is compiled once, with its caller, and not by itself first, and again in the caller's caller. In a
    chain of long functions that halves the time for compiling, or better.
    """
    return _compile(function, _nrt=False, inline="always") if COMPILED else function


def lean_apart(function):
    """As ``lean``, but called, not inlined: for long kernels, which would make each of their callers long.

    A call costs some 10 ns for each array handed over, so hand over arrays, not the tuples that hold many.
    """
    return _compile(function, _nrt=False, forceinline=False) if COMPILED else function


def compiled_apart(function=None, *, door=True):
    """As ``compiled``, but called, not inlined: for long loops over plain arrays, which several others call.

    It keeps the callers' compiling short, and costs some 10 ns an array in each call.
    """
    if function is None:
        return functools.partial(compiled_apart, door=door)
    return _compile(function, forceinline=False, no_cpython_wrapper=not door) if COMPILED else function


def plain(function):
    """The plain Python form of a compiled function, for reading, stepping through, and comparing."""
    return getattr(function, "py_func", function)


def bind(function, *functions):
    """``functools.partial`` for compiled functions: fix the leading arguments, themselves functions.

    Plain functions give a plain partial. Compiled ones give one compiled function, made from the same source
    with the leading arguments turned into global names.
    """
    if not COMPILED or not all(hasattr(f, "py_func") for f in (function, *functions)):
        return functools.partial(plain(function), *functions)
    return _bind_compiled(function, *functions)


@functools.cache
def _bind_compiled(function, *functions):
    source = plain(function)
    tree = ast.parse(textwrap.dedent(inspect.getsource(source)))
    ast.increment_lineno(tree, source.__code__.co_firstlineno - 1)  # so that a traceback shows the right line
    definition = tree.body[0]
    if not isinstance(definition, ast.FunctionDef) or definition.name != source.__name__:
        raise _edited(source)
    definition.decorator_list.clear()
    alone = _defined(tree, definition, source.__globals__)
    if not (_same(source.__code__, alone.__code__) or _in_its_file(source)):
        raise _edited(source)
    fixed = [argument.arg for argument in definition.args.args[: len(functions)]]
    del definition.args.args[: len(functions)]
    # Numba's cache goes by name, not by the globals: another function bound must give another name
    bound = " ".join(f"{plain(f).__module__}.{plain(f).__name__}" for f in functions)
    definition.name = f"{source.__name__}_{hashlib.sha256(bound.encode()).hexdigest()[:12]}"
    names = {**source.__globals__, **dict(zip(fixed, functions, strict=True))}
    kept = ("_nrt", "forceinline", "inline", "no_cpython_wrapper")  # it is compiled as the function given was
    options = {name: function.targetoptions[name] for name in kept if name in function.targetoptions}
    return _compile(_defined(tree, definition, names, source.__code__.co_filename), *functions, **options)


def _same(code, other):
    parts = "co_name", "co_code", "co_consts", "co_names", "co_varnames"
    return all(getattr(code, part) == getattr(other, part) for part in parts)


def _in_its_file(function):
    """Whether the file, compiled as a whole, has this function's code at its place.

    Compiled from its own lines alone it may differ: Python calls ``np.zeros`` in another way where it sees,
    at the top of what it compiles, that np was imported. (A notebook's statements are compiled one by one.)
    """
    code, found = function.__code__, [compile("".join(inspect.findsource(function)[0]), "<source>", "exec")]
    for some in found:  # grows: code within code
        if some.co_firstlineno == code.co_firstlineno and _same(code, some):
            return True
        found += filter(inspect.iscode, some.co_consts)
    return False


def _defined(tree, definition, names, file="<source>"):
    """The function that a tree defines, with these global names."""
    names = dict(names)
    exec(compile(tree, file, "exec"), names)
    return names[definition.name]


def _edited(function):
    return RuntimeError(
        f"{function.__code__.co_filename} was edited after it was imported: restart Python (in Jupyter: "
        f"Kernel → Restart), so that {function.__name__} is what the file says"
    )
