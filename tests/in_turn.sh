# in_turn K PARTS: whether the K-th of so many parts is run, as is_in_turn of tests/check.h has it; all
# of them where no turn is given.  is_whole: whether that is so, or several turns are run at once.  For
# the tests in shell, which include this file.
is_whole() {
    [ -n "${ROLLBEM_TEST_ALL-}" ] || [ -z "${ROLLBEM_TEST_TURN-}" ] || [ "${ROLLBEM_TEST_TURNS:-1}" -gt 1 ]
}
in_turn() {
    [ -n "${ROLLBEM_TEST_ALL-}" ] || [ -z "${ROLLBEM_TEST_TURN-}" ] ||
        [ $(($2 - 1 - ($1 + ROLLBEM_TEST_TURN + $2 - 1) % $2)) -lt "${ROLLBEM_TEST_TURNS:-1}" ]
}
