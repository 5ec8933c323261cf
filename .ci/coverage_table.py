"""Lines covered, per folder of src, from an lcov file; test modules left out."""

import re
import sys
from collections import defaultdict
from pathlib import Path

SOURCES = Path("src").resolve()


def is_test(path):
    """Whether a file holds tests only: its module is declared under `cfg(test)`."""
    return bool(re.search(r"(^|/|_)test(s|ing)(/|\.rs$)|fixture\.rs$", path))


def first_test_line(text):
    """The line of the module of tests at a file's end."""
    lines = text.splitlines()
    for number, (line, following) in enumerate(zip(lines, lines[1:]), 1):
        if line == "#[cfg(test)]" and re.match(r"mod \w+ \{", following):
            return number
    return len(lines) + 1


def read(lcov):
    """By file, the counts of its lines."""
    counts = defaultdict(dict)
    for line in lcov.splitlines():
        key, _, value = line.partition(":")
        if key == "SF":
            path = Path(value).resolve()
        elif key == "DA":
            number, count = value.split(",")[:2]
            counts[path][int(number)] = max(counts[path].get(int(number), 0), int(count))
    return counts


def main():
    files = {}
    for path, lines in read(Path(sys.argv[1]).read_text()).items():
        if not path.is_relative_to(SOURCES):
            continue
        name = path.relative_to(SOURCES).as_posix()
        if is_test(name):
            continue
        end = first_test_line(path.read_text())
        covered = {number: count > 0 for number, count in lines.items() if number < end}
        files[name] = (sum(covered.values()), len(covered), [n for n, hit in sorted(covered.items()) if not hit])
    folders = defaultdict(lambda: [0, 0])
    for name, (hit, lines, _) in files.items():
        for folder in (name.split("/")[0] if "/" in name else "(crate)", "total"):
            folders[folder][0] += hit
            folders[folder][1] += lines
    print("| folder | lines | covered | % |\n|---|---:|---:|---:|")
    for folder, (hit, lines) in sorted(folders.items(), key=lambda item: (item[0] == "total", item[0])):
        print(f"| {folder} | {lines} | {hit} | {100 * hit / lines:.1f} |")
    low = {name: found for name, found in files.items() if found[0] < 0.9 * found[1]}
    for name, (hit, lines, missed) in sorted(low.items()):
        print(f"under 90 %: {name} {100 * hit / lines:.1f} %, lines {' '.join(map(str, missed))}")
    hit, lines = folders["total"]
    sys.exit(hit <= 0.9 * lines)


main()
