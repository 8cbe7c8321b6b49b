"""Run by path in a process of its own: call ``load`` of a script and hand its arrays on as npz on stdout.

Not imported by the package: a damaged file can crash the library that reads it, and only this process dies of that.
"""

import sys
from contextlib import suppress


def bound(memory: int, seconds: int) -> None:
    """Limit this process's address space (bytes), processor time (s) and output, where the system can."""
    try:
        import resource
    except ImportError:  # not on Windows: the parent's timeout remains
        return
    for limit, value in (
        (resource.RLIMIT_AS, memory),
        (resource.RLIMIT_CPU, seconds),
        (resource.RLIMIT_FSIZE, memory),
        (resource.RLIMIT_CORE, 0),
    ):
        hard = resource.getrlimit(limit)[1]
        value = value if hard == resource.RLIM_INFINITY else min(value, hard)
        with suppress(ValueError, OSError):  # a system without this limit
            resource.setrlimit(limit, (value, value))


def main(script: str, memory: str, seconds: str, *arguments: str) -> None:
    """Call ``load(*arguments)`` of *script* within *memory* (bytes) and *seconds*."""
    bound(int(memory), int(seconds))
    import runpy
    import warnings

    import numpy as np

    warnings.simplefilter("ignore")
    found = runpy.run_path(script)["load"](*arguments)
    np.savez(sys.stdout.buffer, **{f"v:{name}": array for name, array in found.items()})


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except MemoryError:
        sys.exit("needs more memory than a file of its size may take")
    except Exception as problem:  # whatever a hostile file provokes, in one line
        text = " ".join(str(problem).split())
        sys.exit(f"{type(problem).__name__}: {text}"[:300])
