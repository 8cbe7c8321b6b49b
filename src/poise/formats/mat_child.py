"""Run by path in a process of its own: load a MATLAB file and hand its numeric arrays on as npz on stdout.

Not imported by the package: a damaged file can crash the library that reads it, and only this process dies of that.
"""

import sys
from contextlib import suppress
from typing import Any

LONGEST_NAME = 200


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


def numbers(value: Any, name: str, found: dict[str, Any], depth: int = 0) -> None:
    """Collect the numeric arrays of *value*, a variable or a struct of them, under dotted names."""
    import numpy as np

    if isinstance(value, dict) and depth < 4:
        for key, part in value.items():
            if not str(key).startswith("__"):
                numbers(part, f"{name}.{key}" if name else str(key), found, depth + 1)
    elif isinstance(value, (np.ndarray, np.number, int, float)) and np.asarray(value).dtype.kind in "fiub":
        array = np.asarray(value)
        if array.ndim <= 3 and len(name) <= LONGEST_NAME and "/" not in name:
            found[name] = array


def main(path: str, memory: str, seconds: str) -> None:
    """Load *path* within *memory* (bytes) and *seconds*."""
    bound(int(memory), int(seconds))
    import warnings

    import numpy as np
    from scipy.io import loadmat

    warnings.simplefilter("ignore")
    found: dict[str, Any] = {}
    numbers(loadmat(path, simplify_cells=True, appendmat=False), "", found)
    np.savez(sys.stdout.buffer, **{f"v:{name}": array for name, array in found.items()})


if __name__ == "__main__":
    try:
        main(*sys.argv[1:4])
    except MemoryError:
        sys.exit("needs more memory than a file of its size may take")
    except Exception as problem:  # whatever a hostile file provokes, in one line
        sys.exit(f"{type(problem).__name__}: {problem}"[:200])
