#!/usr/bin/env bash
# Proof that the suite can fail: one mutation of the product at a time, which the tests have to catch.
#   run.sh check SOURCE                            every mutation's text is in its file exactly once
#   run.sh run SOURCE WORK [NAME...] [-- CMAKE...] builds and tests each one, or those named, in a copy of SOURCE
# A mutation is a file NAME.mutation: a line `file PATH`, a line `what WORDS`, then the old text between <<<< and
# ====, the new text between ==== and >>>>. A text that no longer matches is an error, and so is a mutation that does
# not compile: both prove nothing.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
readonly here
# In the order in which they are asked: the first that fails has caught the mutation.
# A count of hard cases that changes, or a shrinker that stops, is no proof that the picture is judged; the nightly
# sizes take hours.
readonly asked='-*MeetTheHardCases*:Shrink*:*Nightly*'
readonly programs=(sdf property fuzz analytic exact)
readonly copied=(CMakeLists.txt LICENSE README.md analytic cmake data paper_figures pipeline sdf shaders tests)

fail() {
    printf 'mutations: error: %s\n' "$*" >&2
    exit 1
}

# part FILE FROM TO: the lines between two marks
part() { awk -v from="$2" -v to="$3" '$0 == to { inside = 0 } inside; $0 == from { inside = 1 }' "$1"; }
field() { sed -n "s/^$2 //p;/^<<<</q" "$1"; }

# apply MUTATION ROOT: prints the mutated file's text
mutated() {
    local path old new text rest
    path=$2/$(field "$1" file)
    old=$(part "$1" '<<<<' '====')
    new=$(part "$1" '====' '>>>>')
    [[ -f $path && -n $old && $old != "$new" ]] || fail "$1: is no mutation of $path"
    text=$(<"$path")
    rest=${text#*"$old"}
    [[ $rest != "$text" ]] || fail "$1: its text is not in $path"
    [[ ${rest#*"$old"} == "$rest" ]] || fail "$1: its text is in $path more than once"
    printf '%s\n' "${text%%"$old"*}$new$rest"
}

checkAll() {
    local m
    for m in "$here"/*.mutation; do mutated "$m" "$1" >/dev/null; done
    echo "mutations: $(ls "$here"/*.mutation | wc -l) match"
}

# Files that an earlier run mutated are newer than what it built of them.
copySources() {
    local m
    mkdir -p "$2"
    for name in "${copied[@]}"; do
        rm -rf "${2:?}/$name"
        cp -a "$1/$name" "$2/$name"
    done
    for m in "$here"/*.mutation; do touch "$2/$(field "$m" file)"; done
}

# ask COPY LOG: builds one program after the other and prints the first test that fails, or nothing
ask() {
    local program binary status
    for program in "${programs[@]}"; do
        cmake --build "$1/build/release" --target "${program}_tests" >"$2" 2>&1 || fail "does not compile, see $2"
        binary=$(find "$1/build/release/tests" -name "${program}_tests" -type f)
        status=0
        (cd "$1/.." && EDGEWISE_PROPERTY_BUDGET=0 timeout 600 "$binary" --gtest_fail_fast \
            "--gtest_filter=$asked" --gtest_color=no) >"$2" 2>&1 || status=$?
        ((status == 0)) && continue
        sed -n 's/^\[  FAILED  \] \([^ ,]*\).*/\1/p' "$2" | head -1 | grep . ||
            echo "$(sed -n 's/^\[ RUN      \] //p' "$2" | tail -1) (status $status)"
        return
    done
}

runAll() {
    local source=$1 work=$2 survivors=0 m name caught
    shift 2
    local names=() options=()
    while (($# > 0)) && [[ $1 != -- ]]; do names+=("$1") && shift; done
    (($# == 0)) || options=("${@:2}")
    ((${#names[@]} > 0)) || mapfile -t names < <(cd "$here" && ls -- *.mutation | sed 's/\.mutation$//')
    local copy=$work/source
    copySources "$source" "$copy"
    cmake -S "$copy" -B "$copy/build/release" -G Ninja -D CMAKE_BUILD_TYPE=Release "${options[@]}" >"$work/configure.log" 2>&1 ||
        fail "cannot configure, see $work/configure.log"
    caught=$(ask "$copy" "$work/unmutated.log")
    [[ -z $caught ]] || fail "$caught fails without any mutation, see $work/unmutated.log"
    for name in "${names[@]}"; do
        m=$here/$name.mutation
        [[ -f $m ]] || fail "$name: no such mutation"
        local file=$copy/$(field "$m" file)
        mutated "$m" "$source" >"$file"
        caught=$(ask "$copy" "$work/$name.log")
        cat "$source/$(field "$m" file)" >"$file"
        [[ -n $caught ]] || survivors=$((survivors + 1))
        printf '%-34s %s\n' "$name" "${caught:-SURVIVES: $(field "$m" what)}"
    done
    ((survivors == 0)) || fail "$survivors mutations survive"
}

case ${1-} in
    check) checkAll "$2" ;;
    run) runAll "${@:2}" ;;
    *) sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" && exit 2 ;;
esac
