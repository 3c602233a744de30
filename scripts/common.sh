# Sourced by the other scripts: strict mode, the repository's root as working folder, --help.
# shellcheck shell=bash
set -euo pipefail
script=$(realpath "$0")
# shellcheck disable=SC2034  # used by the scripts that take a path from the caller
called_from=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '%s: %s\n' "${script##*/}" "$*" >&2; }
fail() { say "$1"; exit "${2:-1}"; }

# Prints the comment at the head of the script when the first argument asks for help.
help_if_asked() {
  case ${1:-} in
    -h | --help) sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$script"; exit 0 ;;
  esac
}

# step NAME COMMAND...: runs the command and tells how long it took.
step() {
  local name=$1 start=$SECONDS
  shift
  say "$name ..."
  "$@" || fail "$name FAILED after $((SECONDS - start)) s"
  say "$name: done in $((SECONDS - start)) s"
}
