# in_turn K PARTS: whether the K-th of so many parts is run, as is_in_turn of tests/check.h has it; all
# of them where no turn is given.  For the tests in shell, which include this file.
in_turn() {
    [ -n "${ROLLBEM_TEST_ALL-}" ] || [ -z "${ROLLBEM_TEST_TURN-}" ] || [ $((($1 + ROLLBEM_TEST_TURN) % $2)) -eq 0 ]
}
