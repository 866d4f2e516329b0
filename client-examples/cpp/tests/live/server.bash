# What every live test has: a server, and a program that is expected to do something. To be sourced with the program in $program.
set -euo pipefail
traverse=${TRAVERSE_BINARY:?set it to the traverse binary}

out=$(mktemp -d)
server=
stop() {
    [ -n "$server" ] || return 0
    kill "$server" 2>/dev/null || true
    wait "$server" || true
    server=
}
trap 'stop; rm -rf "$out"' EXIT

# serve PORT: starts a server; address is HOST:PORT once it listens.
serve() {
    rm -f "$out/says"
    mkfifo "$out/says"
    "$traverse" serve --listen "127.0.0.1:$1" >"$out/says" 2>"$out/log" &
    server=$!
    read -r line <"$out/says" || { cat "$out/log" >&2; exit 1; }
    address=${line##*http://}
}

# wrong TEXT: ends the test with what the program answered last.
wrong() {
    echo "live: $*" >&2
    cat "$out/answer" >&2
    exit 1
}

# ends CODE ARGUMENT…: the program ends with the code.
ends() {
    local code=$1 ended=0
    shift
    "$program" "$@" >"$out/answer" 2>&1 || ended=$?
    [ "$ended" = "$code" ] || wrong "$* ended with $ended, not $code:"
}

# says TEXT…: it said each of them.
says() {
    local text
    for text in "$@"; do
        grep -q -- "$text" "$out/answer" || wrong "'$text' was not said:"
        echo "ok: $text"
    done
}

# expect CODE TEXT ARGUMENT…: the program ends with the code and says the text.
expect() {
    ends "$1" "${@:3}"
    says "$2"
}

# waits_for_server ARGUMENT…: the program with these after the address, called while no server listens there, answers once
# there is one. Leaves it running.
waits_for_server() {
    local port=${address##*:} late
    stop
    "$program" "127.0.0.1:$port" "$@" >"$out/answer" 2>&1 &
    late=$!
    serve "$port"
    wait "$late" || wrong "no answer from a server that came up late:"
    echo "ok: a server that comes up late is waited for"
}
