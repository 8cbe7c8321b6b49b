"""What the bounded child runs for a MATLAB file; not imported by the package."""

from typing import Any

LONGEST_NAME = 200


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


def load(path: str) -> dict[str, Any]:
    """The numeric arrays in the file at *path*."""
    from scipy.io import loadmat

    found: dict[str, Any] = {}
    numbers(loadmat(path, simplify_cells=True, appendmat=False), "", found)
    return found
