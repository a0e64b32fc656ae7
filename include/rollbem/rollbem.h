/* All public headers of rollbem. */
#ifndef ROLLBEM_ROLLBEM_H
#define ROLLBEM_ROLLBEM_H

#include "rollbem/base.h"
#include "rollbem/bem.h"
#include "rollbem/fem.h"
#include "rollbem/friction.h"
#include "rollbem/lcp.h"
#include "rollbem/rolling.h"

#endif
