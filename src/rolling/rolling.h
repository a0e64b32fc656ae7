/* What src/analysis and src/program use of rolling contact besides rollbem/rolling.h: the headers
 * by topic that stand beside their sources. */
#ifndef ROLLBEM_ROLLING_ROLLING_H
#define ROLLBEM_ROLLING_ROLLING_H

#include "rolling/case/derived.h"
#include "rolling/body/body.h"
#include "rolling/body/gap.h"
#include "rolling/solve/law_iteration.h"
#include "rolling/solve/model.h"
#include "rolling/solve/solution.h"
#include "rolling/solve/pressed.h"
#include "rolling/solve/temperature.h"
#include "rolling/solve/variant.h"
#include "rolling/results/results.h"
#include "rolling/notes/notes.h"
#include "rolling/stress/stress.h"
#include "rolling/history/history.h"
#include "rolling/history/wear.h"
#include "rolling/study/study.h"

#endif
