/* Whether this process is one of several. */
#include "program/cli/pool.h"

#include <stdlib.h>
#include <string.h>

int cli_pool_is_launched(void)
{
    const char *size = getenv("OMPI_COMM_WORLD_SIZE");

    return size ? strcmp(size, "1") != 0 : getenv("PMIX_RANK") != NULL;
}
