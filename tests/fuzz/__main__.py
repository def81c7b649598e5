"""Fuzz every language for its share of some minutes: `python -m tests.fuzz MINUTES [SUFFIX …]`.

Atheris (the extra `fuzz`) leads the mutations by what code they reach; without it they are random.
What breaks a rule is printed and kept in `build/fuzz/found`; put it into `tests/fuzz/found`.
"""

from __future__ import annotations

import importlib.util
import random
import subprocess
import sys
import time
import traceback
from hashlib import sha256
from pathlib import Path

from tests.fuzz.mutation import LARGEST, SUFFIXES, mutated, seeds
from tests.fuzz.oracle import assert_properties

HOME = Path("build/fuzz")
TEXT_S = 60
"""What takes longer than this [s] hangs; atheris keeps it as `build/fuzz/timeout-…`."""
FOUND = HOME / "found"


def holds(suffix: str, text: str) -> bool:
    """Whether all rules hold for `text`; prints and keeps one for which they do not."""
    try:
        assert_properties(suffix, text)
    except Exception:
        data = text.encode("utf-8", "replace")
        path = FOUND / f"{sha256(data).hexdigest()[:10]}{suffix}"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
        print(f"{path}\n{traceback.format_exc(limit=-4)}", flush=True)
        return False
    return True


def undirected(suffix: str, seconds: float) -> int:
    """Random mutations for some seconds; how many broke a rule."""
    rng, until = random.Random(), time.monotonic() + seconds
    broken = rounds = 0
    while time.monotonic() < until and broken < 5:
        broken += not holds(suffix, mutated(suffix, rng))
        rounds += 1
    print(f"{suffix}: {rounds} texts, {broken} broke a rule", flush=True)
    return broken


def directed(suffix: str, seconds: float) -> None:
    """Mutations that atheris finds worth while; ends the process, with 1 if one broke a rule."""
    import atheris  # noqa: PLC0415 - an optional package

    corpus = HOME / suffix[1:]
    corpus.mkdir(parents=True, exist_ok=True)
    for number, text in enumerate(seeds(suffix)):
        (corpus / f"seed{number}").write_text(text, "utf-8", "replace")

    def check_input(data: bytes) -> None:
        if not holds(suffix, data.decode("utf-8", "replace")):
            sys.stdout.flush()
            raise SystemExit(1)

    def mutate(data: bytes, most: int, seed: int) -> bytes:
        rng = random.Random(seed)
        if rng.random() < 0.3:
            return atheris.Mutate(data, most)
        text = mutated(suffix, rng, data.decode("utf-8", "replace") or None)
        return text.encode("utf-8", "replace")[:most]

    atheris.instrument_all()
    limits = [f"-max_len={LARGEST}", f"-timeout={TEXT_S}", "-rss_limit_mb=1500"]
    options = [f"-max_total_time={seconds:.0f}", *limits]
    quiet = ["-print_final_stats=1", "-verbosity=0", f"-artifact_prefix={HOME}/"]
    atheris.Setup(["fuzz", *options, *quiet, str(corpus)], check_input, custom_mutator=mutate)
    atheris.Fuzz()


def main(arguments: list[str]) -> int:
    """Fuzz the languages one after the other, each in a process of its own."""
    minutes, chosen = float(arguments[0]), tuple(arguments[1:]) or SUFFIXES
    share = 60 * minutes / len(chosen)
    has_atheris = importlib.util.find_spec("atheris") is not None
    broken = []
    for suffix in chosen:
        print(
            f"== {suffix}: {share:.0f} s {'' if has_atheris else '(without atheris)'}", flush=True
        )
        command = [sys.executable, "-m", "tests.fuzz", "one", suffix, str(share)]
        try:
            held = subprocess.run(command, check=False, timeout=share + 5 * TEXT_S).returncode == 0
        except subprocess.TimeoutExpired:
            print(f"{suffix}: did not end; too busy a machine, or something that hangs", flush=True)
            held = False
        if not held:
            broken.append(suffix)
    print(f"rules were broken in: {', '.join(broken)}" if broken else "all rules held")
    return 1 if broken else 0


def single(suffix: str, seconds: float) -> int:
    """Fuzz one language in this process."""
    if importlib.util.find_spec("atheris") is not None:
        directed(suffix, seconds)
        return 0
    return 1 if undirected(suffix, seconds) else 0


if __name__ == "__main__":
    if sys.argv[1] == "one":
        raise SystemExit(single(sys.argv[2], float(sys.argv[3])))
    raise SystemExit(main(sys.argv[1:]))
