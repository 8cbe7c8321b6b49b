"""Fuzzes the readers of text, Parquet and npz files, led by their coverage: a signal, a hang or another error is a find.

    python benchmarks/fuzz.py [--seconds N] [--corpus FOLDER]

Needs atheris (pip install atheris) and says so where it is absent. MATLAB files and bags go through a process each,
which is too slow for this: `benchmarks/files.py F3` damages them at random.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path

import broken_files

KINDS = ("text", "parquet", "npz")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else "")
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--corpus", type=Path, help="what was found worth keeping; kept for the next time")
    parser.add_argument("--inside", type=Path, help=argparse.SUPPRESS)
    told = parser.parse_args()
    if find_spec("atheris") is None:
        print("atheris is not installed (pip install atheris): nothing is fuzzed")
        return 0
    if told.inside:
        fuzz(told.inside, told.corpus, told.seconds)
    with tempfile.TemporaryDirectory() as name:  # the fuzzer leaves without cleaning up
        folder = Path(name)
        corpus = told.corpus or folder / "corpus"
        corpus.mkdir(exist_ok=True)
        for kind, whole in broken_files.whole(folder).items():
            if not kind.startswith(("mat", "bag", "mcap")):
                (corpus / kind.replace(" ", "-")).write_bytes(whole.read_bytes()[:20_000])
        for kind, case in broken_files.written().items():
            (corpus / f"text {kind}".replace(" ", "-").replace("/", "-")).write_bytes(case.content[:2000])
        command = [sys.executable, __file__, "--inside", name, "--corpus", str(corpus), "--seconds", str(told.seconds)]
        return subprocess.run(command, check=False).returncode


def fuzz(folder: Path, corpus: Path, seconds: int) -> None:
    """Read files made of what is in *corpus* until the time is over or something is found; ends the process."""
    import atheris

    with atheris.instrument_imports(include=["poise.formats"]):
        from poise import PoiseError, read_chunks
        from poise.formats import recognise

    path = folder / "fuzzed"

    def one(data: bytes) -> None:
        path.write_bytes(data)
        try:
            if data and recognise.kind(str(path), path) in KINDS:
                for _ in read_chunks(path, 50):
                    pass
        except PoiseError as problem:
            if not str(problem).startswith(str(path)):
                raise

    limits = [f"-max_total_time={seconds}", "-timeout=5", "-rss_limit_mb=1024", "-max_len=20000"]
    atheris.Setup([sys.argv[0], *limits, f"-artifact_prefix={Path.cwd()}/", str(corpus)], one)
    atheris.Fuzz()


if __name__ == "__main__":
    sys.exit(main())
