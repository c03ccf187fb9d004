# What the scripts in the guest check with. $failed and $checks count; a program's output is in `said`.
failed=0
checks=0

check() { # check WHAT COMMAND...
    what=$1
    shift
    checks=$((checks + 1))
    if "$@"; then echo "ok   $what"; else echo "FAIL $what"; failed=$((failed + 1)); fi
}
finish_checks() { # finish_checks NAME: the status of the script
    [ "$failed" != 0 ] || echo "$1: all $checks checks passed"
    [ "$failed" = 0 ]
}
level() { cat "/gpio/$1/value"; }
is_level() { [ "$(level "$1")" = "$2" ]; }
says() { grep -q "$1" said; }
await_level() { # the level of line $1 becomes $2 within $3 s, 30 if that is not given
    tries=0
    until is_level "$1" "$2"; do
        tries=$((tries + 1))
        [ "$tries" -lt $((${3:-30} * 10)) ] || return 1
        sleep 0.1
    done
}
trace_length() { gpio-trace | wc -l; }
# What was driven on line $1 since trace line $2, each change once, such as "0 1 0".
driven() {
    gpio-trace | tail -n +$(($2 + 1)) |
        awk -v line="$1" '$2 == line && $3 == "set" && $4 "" != last { last = $4 ""; print last }' |
        tr '\n' ' ' | sed 's/ $//'
}
was_driven() { # was_driven LINE SINCE VALUES
    got=$(driven "$1" "$2")
    [ "$got" = "$3" ] || { echo "     $1 was driven: $got; expected: $3"; return 1; }
}
# Letting go of a line leaves no trace: its last command since trace line $2 was off.
last_driven_off() { got=$(driven "$1" "$2"); [ "${got##* }" = 0 ]; }
# The time of the last change to 0 that was driven on line $1 since trace line $2.
driven_off_at() {
    gpio-trace | tail -n +$(($2 + 1)) | awk -v line="$1" '
        $2 == line && $3 == "set" { if ($4 == 0 && last != 0) at = $1; last = $4 } END { print at }'
}
now() { cut -d" " -f1 /proc/uptime; }
within() { # within LINE SINCE START SECONDS: driven off so soon after the start
    at=$(driven_off_at "$1" "$2")
    awk -v at="$at" -v start="$3" -v limit="$4" 'BEGIN { exit !(at != "" && at - start < limit) }' ||
        { echo "     $1 was driven off at: $at; started: $3"; return 1; }
}
# The processes whose parent is $1.
children_of() { grep -l "^PPid:[[:space:]]*$1$" /proc/[0-9]*/status 2>/dev/null | cut -d/ -f3; }
fresh_trace() { echo >/sys/kernel/tracing/trace; }
