#include "rollbem/rollbem.h"

int main(void)
{
    return 70;
}
