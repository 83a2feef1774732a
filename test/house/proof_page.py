"""Each pattern that a page gives to ctest names a test: proof_page.py CTEST BUILD_FOLDER PAGE..."""

import re
import subprocess
import sys

ctest, folder, *pages = sys.argv[1:]
listed = subprocess.run([ctest, "--test-dir", folder, "-N"], check=True, capture_output=True, text=True).stdout
names = re.findall(r"^ *Test +#\d+: (\S+)", listed, re.MULTILINE)
count = unknown = 0
for page in pages:
    with open(page, encoding="utf-8") as file:
        patterns = re.findall(r"`ctest -R '([^']+)'", file.read())
    for pattern in patterns:
        for part in pattern.split(r"\|"):  # as tables have it
            if not any(re.search(part, name) for name in names):
                unknown += 1
                print(f"{page}: no test is named by {part}")
    count += len(patterns)
print(f"{count} patterns, {len(names)} tests")
sys.exit(1 if unknown or count == 0 else 0)
