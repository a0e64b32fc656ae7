/* All public headers of rollbem. */
#ifndef ROLLBEM_ROLLBEM_H
#define ROLLBEM_ROLLBEM_H

#include "rollbem/api.h"
#include "rollbem/base.h"
#include "rollbem/bem.h"
#include "rollbem/case.h"
#include "rollbem/contact.h"
#include "rollbem/friction.h"
#include "rollbem/io.h"
#include "rollbem/lcp.h"
#include "rollbem/rolling.h"
#include "rollbem/sparse.h"

#endif
