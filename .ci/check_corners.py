"""The work of .ci/check_corners. The independent checker is imported once, since it takes longer to start than to check."""

import json
import multiprocessing
import os
import re
import subprocess
import sys
import tempfile

import check_mesh

BITING = os.environ.get("BITING", "target/release/biting")
PAIRS = [(0.25, 0.25), (0.25, 0.75)]
MIN_ANGLE = 14.47
SECONDS = 300


def gallery():
    """Names of the gallery's domains, as `list` prints them."""
    listed = subprocess.run([BITING, "list"], capture_output=True, text=True, check=True, timeout=60).stdout
    part = listed.split("Domains", 1)[1].split("FILE.poly", 1)[0]
    return re.findall(r"^  ([a-z0-9-]+) +\d+", part, re.M)


def judge(task):
    """One mesh: whether it passes, what is wrong, its smallest free angle and its counts."""
    domain, t, c_b = task
    with tempfile.TemporaryDirectory() as place:
        stem = os.path.join(place, "m")
        command = [BITING, "mesh", domain, "--spacing", "lfs", "--t", str(t), "--c-b", str(c_b), "--threads", "1"]
        command += ["--out", stem + ".node", "--out", stem + ".poly", "--report", stem + ".json"]
        try:
            run = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS)
        except subprocess.TimeoutExpired:
            return task, [f"no end within {SECONDS} s"], None, {}
        if run.returncode:
            return task, [f"exit status {run.returncode}: {run.stderr.strip()[-300:]}"], None, {}
        with open(stem + ".json") as file:
            counts = dict(json.load(file)["counts"])
        verdict = check_mesh.check(stem + ".poly", stem, MIN_ANGLE)
        return task, verdict["bad"], verdict["min_angle_free"], counts


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    polygons = [f"random-simple:n={5 + 37 * seed % 196},seed={seed}" for seed in range(first, first + count)]
    named = [domain for domain in gallery() if domain not in sys.argv[3:]]
    failed = 0
    for title, domains in [("gallery", named), ("random polygons", polygons)]:
        for t, c_b in PAIRS:
            angles, cut, wrong = [], 0, 0
            with multiprocessing.Pool(os.cpu_count()) as pool:
                for (domain, *_), bad, angle, counts in pool.imap_unordered(judge, [(d, t, c_b) for d in domains]):
                    cut += int(counts.get("corners_cut", 0))
                    angles += [angle] if angle is not None else []
                    if bad:
                        wrong += 1
                        print(f"FAILED {domain} t={t} c_b={c_b}: {'; '.join(bad)}", flush=True)
            least = f"{min(angles):.2f}" if angles else "none"
            print(f"{title}, t={t} c_b={c_b}: {len(domains) - wrong} of {len(domains)} pass, {cut} corners cut off, "
                  f"smallest free angle {least}", flush=True)
            failed += wrong or not domains
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
