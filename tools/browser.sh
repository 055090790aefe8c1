#!/usr/bin/env bash
# The tests of `ion view` look at its page in a real browser: chromium, from the system's packages.
# Installs it where it is missing and may be installed; otherwise says what is to be done, and the
# tests skip.
set -euo pipefail

if command -v chromium chromium-browser google-chrome > /dev/null; then
    exit 0
fi
if [ "$(id -u)" -ne 0 ] || ! command -v apt-get > /dev/null; then
    echo "no chromium here: the tests of the web page skip; install the package chromium" >&2
    exit 0
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
export DEBIAN_FRONTEND=noninteractive
if ! { apt-get update && apt-get install -y --no-install-recommends chromium; } > "$log" 2>&1; then
    tail -n 3 "$log" >&2
    echo "chromium could not be installed: the tests of the web page skip" >&2
fi
