# rollbem: make help

PREFIX ?= /usr/local
LIBDIR ?= $(PREFIX)/lib
B ?= build
CC ?= cc
CFLAGS ?= -O3 -g
STD = -std=c11 -D_POSIX_C_SOURCE=200809L -Wall -Wextra -Wpedantic -Wshadow
# without OpenMP the loops run on one processor
OPENMP := $(shell echo 'int main(void) { return 0; }' | $(CC) -fopenmp -x c -o /dev/null - 2>/dev/null && echo -fopenmp || echo -Wno-unknown-pragmas)
# Debian's name for HDF5, or everybody else's
HDF5 := $(shell pkg-config --exists hdf5-serial 2>/dev/null && echo hdf5-serial || echo hdf5)
# rollbem design: where NLopt is; make NLOPT= goes without
NLOPT := $(shell pkg-config --exists nlopt 2>/dev/null && echo nlopt)
PKGS = openblas lapacke gsl inih jansson $(HDF5) fftw3 $(NLOPT)
# SuiteSparse 5 has no pkg-config file
SUITESPARSE = -lumfpack -lspqr -lcholmod -lsuitesparseconfig
# -lgslcblas would shadow OpenBLAS: take GSL's flags without it
LDLIBS += $(filter-out -lgslcblas,$(shell pkg-config --libs $(PKGS) 2>/dev/null)) -lfftw3_threads $(SUITESPARSE) -lglpk -lm $(OPENMP)
# The program takes archives where there are any: a shared library that a case never uses costs its
# start as well, and thirty of them (HDF5's for files on the web: curl, Kerberos, LDAP) cost more than
# a small case, OpenBLAS's alone a quarter of the start.  make ARCHIVES= takes none; where they want more
# than is named here the shared ones are linked.
LIBRARY_FOLDER := $(dir $(filter /%,$(shell $(CC) -print-file-name=libgsl.a)))
ARCHIVED := lapacke gsl fftw3_threads fftw3 nlopt glpk inih jansson sz aec z umfpack spqr cholmod amd colamd ccolamd camd suitesparseconfig
HDF5_ARCHIVE := $(if $(filter hdf5-serial,$(HDF5)),$(wildcard $(patsubst -L%,%/libhdf5.a,$(shell pkg-config --libs-only-L $(HDF5)))))
GOMP_ARCHIVE := $(filter /%,$(shell $(CC) -print-file-name=libgomp.a))
# OpenBLAS's LAPACK is in Fortran
FORTRAN_ARCHIVES := $(filter /%,$(foreach name,gfortran quadmath,$(shell $(CC) -print-file-name=lib$(name).a)))
OPENBLAS_ARCHIVE := $(if $(filter %/libgfortran.a,$(FORTRAN_ARCHIVES)),$(wildcard $(patsubst -L%,%/libopenblas.a,$(shell pkg-config --libs-only-L openblas))))
ARCHIVES := $(GOMP_ARCHIVE) $(HDF5_ARCHIVE) $(if $(OPENBLAS_ARCHIVE),$(OPENBLAS_ARCHIVE) $(FORTRAN_ARCHIVES)) $(if $(LIBRARY_FOLDER),$(wildcard $(ARCHIVED:%=$(LIBRARY_FOLDER)lib%.a)))
# SuiteSparse 5 has METIS in a library of its own
METIS := $(if $(ARCHIVES),$(if $(LIBRARY_FOLDER),$(firstword $(wildcard $(LIBRARY_FOLDER)libmetis.so.5))))
# and GLPK's archive wants libtool's loader, whose development files need not be there
LTDL := $(if $(filter %/libglpk.a,$(ARCHIVES)),$(firstword $(wildcard $(LIBRARY_FOLDER)libltdl.so.7)))
WITHOUT_ARCHIVES = $(filter-out $(if $(HDF5_ARCHIVE),-lhdf5) $(if $(OPENBLAS_ARCHIVE),-lopenblas) $(patsubst $(LIBRARY_FOLDER)lib%.a,-l%,$(ARCHIVES)),$(LDLIBS))
PROGRAM_LIBS = -Wl,--start-group $(ARCHIVES) -Wl,--end-group -Wl,--as-needed $(METIS) $(LTDL) $(WITHOUT_ARCHIVES)
CPPFLAGS += $(OPENMP) -DRB_NLOPT=$(words $(NLOPT)) -Iinclude -Isrc $(shell pkg-config --cflags $(PKGS) 2>/dev/null)
# rollbem-mpi, for studies over machines: where Open MPI's headers are; make MPI= goes without
MPI := $(shell pkg-config --exists ompi-c 2>/dev/null && echo ompi-c)
# Hardening: fortified calls of the C library, stack protectors, addresses that change with every
# run, relocations read-only before main.  Sanitizers check more, and fortified calls hide from
# them; the C library fortifies optimised code only.
works = $(shell echo 'int main(void) { return 0; }' | $(CC) $(filter-out --coverage,$(CFLAGS)) -Werror $(1) -include stdio.h -x c -o /dev/null - 2>/dev/null && echo '$(1)')
ifeq ($(findstring -fsanitize,$(CFLAGS)),)
HARDEN := $(call works,-fstack-protector-strong) $(call works,-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
HARDEN_SO := $(call works,-z relro -z now)
HARDEN_LD := $(HARDEN_SO) $(call works,-fPIE -pie)
endif
# make V=1 shows the whole commands
Q := $(if $(filter 1,$(V)),,@)
VERSION := $(shell sed -n 's/.*RB_VERSION "\(.*\)"/\1/p' include/rollbem/base.h)

LIB_SRC := $(filter-out src/program/cli/% src/program/mpi/%,$(wildcard src/*/*.c src/*/*/*.c))
CLI_SRC := $(wildcard src/program/cli/*.c)
LIB_OBJ := $(LIB_SRC:%.c=$(B)/%.o)
# the finite elements of `rollbem example` are a part of the program, not of the library
FEM_OBJ := $(patsubst %.c,$(B)/%.o,$(wildcard examples/fem/*.c))
CLI_OBJ := $(CLI_SRC:%.c=$(B)/%.o) $(FEM_OBJ)
# the same program with another worker pool
MPI_OBJ := $(filter-out %/cli/pool.o,$(CLI_OBJ)) $(B)/src/program/mpi/pool.o
PROGRAMS := $(B)/rollbem $(if $(MPI),$(B)/rollbem-mpi)
TESTS := $(patsubst tests/%.c,$(B)/tests/%,$(wildcard tests/test_*.c))
BENCHES := $(patsubst tools/bench/%.c,$(B)/bench/%,$(wildcard tools/bench/bench_*.c))

.PHONY: test-rest some-tests journeys dist deb release site course page page-where-possible page-test page-format page-lint python-test install-python all run test test-all check-tests kernels covered-tests asan asan-short short-tests fuzz mutants coverage hostile endurance platforms analyse check-format bench install uninstall help clean packages check-packages study
all: check-packages $(B)/librollbem.a $(B)/librollbem.so $(PROGRAMS)

help:
	@echo "make            build $(B)/rollbem and the libraries (installs nothing)"
	@echo "make run        install missing packages, build, solve and print a wheel on a rail"
	@echo "make test       install missing packages, build, run all tests; T=rolling_wheel: that one"
	@echo "                T=rolling_wheel NAME=a_test: that function; ROLLBEM_TEST_TURN=N: which rows of long tests"
	@echo "make test-rest  rows of long tests that make test leaves to its next REST=7 turns"
	@echo "make test-all   the same without leaving out any case of the long tests, then the campaigns of docs/validation.md"
	@echo "make asan       the tests under the address and undefined-behaviour sanitizers"
	@echo "make asan-short some of them"
	@echo "make fuzz       libFuzzer on every target of tools/fuzz/, FUZZ_TIME=60 seconds each (wants clang)"
	@echo "make mutants    do the tests notice MUTANTS=300 changes of the source? score and survivors"
	@echo "make coverage   lines and branches of src/ that the tests go through, and what is left"
	@echo "make hostile    N=20000 cases at the ends of what is accepted, judged independently"
	@echo "make endurance  KILLS=1000 kills of a study; memory over CASES=100000 and SOLVES=10000 cases"
	@echo "make kernels    tests that compare digits under every kernel of OpenBLAS that the processor can run"
	@echo "make platforms  the tests with other compilers, BLAS, threads; PLATFORMS=... some of them"
	@echo "make analyse    gcc -fanalyzer and -Wconversion, clang-tidy, cppcheck on src/"
	@echo "make check-format  names sources that clang-format would change"
	@echo "make study      the friction solvers on published files and on packings: tables, false successes;"
	@echo "                PARTS=\"packings portfolio\": some of them, tools/scripts/friction-study says which"
	@echo "make bench      the benchmarks (ratios measured in one run)"
	@echo "make page       the page for browsers, $(B)/rollbem.html; make page-test tests it"
	@echo "make python-test   tests of the Python package, python/"
	@echo "make course     the pictures of the course, docs/course, in $(B)/course"
	@echo "make journeys   what people of eight kinds do on their first day"
	@echo "make site       the documentation as a site, $(B)/site/index.html"
	@echo "make dist       the sources of the last commit, $(B)/rollbem-$(VERSION).tar.gz"
	@echo "make deb        Debian packages, $(B)/deb"
	@echo "make release    all archives and packages of the last commit, each installed and run, $(B)/release"
	@echo "make install    to PREFIX=$(PREFIX), below DESTDIR; make uninstall takes it away"
	@echo "make clean      remove $(B)"

packages: ; @tools/scripts/packages --install
check-packages: ; @tools/scripts/packages

run: packages
	@$(MAKE) --no-print-directory B=$(B) all >&2
	@echo "A braked steel wheel on a steel rail: rollbem --example rail --creep-ratio 0.4"
	@$(B)/rollbem --example rail --creep-ratio 0.4 --format brief
	@echo "Next: $(B)/rollbem help, $(B)/rollbem examples, --plot rail.png for a picture, make test"
	@if [ -f $(B)/rollbem.html ]; then echo "In a browser, the same wheel to turn and to brake: $(B)/rollbem.html"; \
	else echo "In a browser, the same wheel to turn and to brake: make page writes $(B)/rollbem.html"; fi

# make test T=rolling_wheel builds and runs one program, tests/test_rolling_wheel.c; T="rolling_heat
# rolling_wear" those two; NAME=a_test, or a pattern, picks functions of one
T ?=
NAME ?=
test: packages
	@$(MAKE) --no-print-directory B=$(B) $(if $(T),some-tests,check-tests)
some-tests: all $(T:%=$(B)/tests/test_%)
	@$(if $(NAME),B=$(B) CMOCKA_MESSAGE_OUTPUT=STDOUT $(T:%=$(B)/tests/test_%) '$(NAME)',B=$(B) ROLLBEM_TEST_VERBOSE=1 tests/run $(T:%=$(B)/tests/test_%))

# tests with more cases than a minute allows run a part of them unless this variable is set; then
# the campaigns of docs/validation.md in sizes that fit into an hour
test-all:
	@ROLLBEM_TEST_ALL=1 $(MAKE) --no-print-directory B=$(B) test
	@$(MAKE) --no-print-directory B=$(B) hostile N=2000
	@$(MAKE) --no-print-directory B=$(B) endurance KILLS=100 CASES=5000 SOLVES=2000
	@$(MAKE) --no-print-directory B=$(B) platforms PLATFORMS="clang two-threads reference-blas"
	@$(MAKE) --no-print-directory B=$(B) kernels KERNEL_TESTS="$(filter-out $(KERNEL_BLIND),$(LONGEST) $(filter-out $(LONGEST),$(OTHERS)))"
	@if command -v $(FUZZ_CC) >/dev/null; then $(MAKE) --no-print-directory B=$(B) fuzz FUZZ_TIME=20; else echo "fuzz: no $(FUZZ_CC)"; fi
	@$(MAKE) --no-print-directory B=$(B) analyse

# the longest programs start first, so that no processor waits for one of them at the end
LONGEST := tests/page $(B)/tests/test_cli_rolling tests/python $(patsubst %,$(B)/tests/test_%,stress_maxima fit faults check net cli_crack cli sweep rolling_wear) tests/install $(patsubst %,$(B)/tests/test_%,course cli_examples rolling_laws api_stop recorded) tests/site tests/formulas tests/journeys/terminal $(patsubst %,$(B)/tests/test_%,fuzz slopes certificates stack units fclib mistakes random_abilities tilt rolling_turn error_bars stress_b) tests/figures tests/journeys/contributor $(patsubst %,$(B)/tests/test_%,smooth commands inside_hierarchical rolling_wheel fem_cli large rolling_results friction_portfolio) tests/journeys/phd-student-in-python $(patsubst %,$(B)/tests/test_%,crack_growth fem_examples design)
OTHERS := tests/octave tests/install tests/release tests/figures tests/formulas $(wildcard tests/journeys/*) $(TESTS)

# only the summary line comes last: continuous integration reads it
check-tests: all page-where-possible $(if $(shell command -v gnuplot),$(B)/course/.drawn) $(TESTS) $(B)/packings $(if $(ROLLBEM_TEST_ALL),$(BENCHES),$(B)/bench/bench_large)
	@B=$(B) tests/run $(LONGEST) $(filter-out $(LONGEST),$(OTHERS))

# what make test leaves to the next turns: of the programs whose tests take turns the rows of so many more, and
# the whole of those of which make test runs one smoke test
REST ?= 7
IN_TURNS = $(patsubst tests/%.c,$(B)/tests/%,$(shell grep -lwE 'is_in_turn|IN_TURN|run_pages?' tests/test_*.c)) \
    tests/page tests/site tests/python tests/install tests/release tests/formulas tests/figures $(wildcard tests/journeys/*)
test-rest: all page-where-possible $(if $(shell command -v gnuplot),$(B)/course/.drawn) $(TESTS) $(B)/packings $(B)/bench/bench_large
	@turn=$${ROLLBEM_TEST_TURN:-$$(date +%-j)}; ROLLBEM_TEST_TURN=$$((turn + 1)) ROLLBEM_TEST_TURNS=$(REST) B=$(B) \
		tests/run $(filter $(IN_TURNS),$(LONGEST) $(filter-out $(LONGEST),$(OTHERS)))

# the tests that compare digits and what is printed, under each kernel of OpenBLAS that the processor
# can run, each with the next turn of long tests; make test-all: all but those that compute nothing or
# build by themselves
KERNELS ?= $(shell tools/scripts/kernels)
KERNEL_TESTS ?= $(patsubst %,$(B)/tests/test_%,recorded course facts certificates lcp lcp_scale inside_lcp lcp_mixed friction inside_newton bem_system fem crack rolling_plane rolling_shakedown api)
KERNEL_BLIND = tests/page tests/site tests/install tests/release tests/octave tests/python tests/journeys/% $(B)/tests/test_symbols $(B)/tests/test_hardening $(B)/tests/test_fuzz
kernels: all $(TESTS) $(B)/packings $(B)/bench/bench_large
	@rm -f $(B)/course/.drawn # each draws the pictures of the course
	@turn=$${ROLLBEM_TEST_TURN:-$$(date +%-j)}; \
	for kernel in $(KERNELS); do turn=$$((turn + 1)); echo "== OPENBLAS_CORETYPE=$$kernel"; \
		ROLLBEM_TEST_TURN=$$turn OPENBLAS_CORETYPE=$$kernel B=$(B) tests/run $(KERNEL_TESTS) || exit 1; done

SANITIZED = B=build/asan PAGE=$(B)/page CFLAGS="-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined"
asan:
	@$(MAKE) --no-print-directory $(SANITIZED) test

# every target of tools/fuzz/ in turn, or FUZZ_TARGET, for FUZZ_TIME seconds each; wants clang
FUZZ_TIME ?= 60
FUZZ_CFLAGS = -O2 -g -fno-omit-frame-pointer -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined -fsanitize-coverage-ignorelist=tools/fuzz/untraced
fuzz:
	@$(MAKE) --no-print-directory B=$(B)/fuzzing CC="$(FUZZ_CC)" CFLAGS="$(FUZZ_CFLAGS)" $(B)/fuzzing/fuzzer
	@tools/fuzz/run $(B)/fuzzing $(FUZZ_TIME) $(FUZZ_TARGET)
FUZZ_CC ?= clang

# do the tests notice changes of the source?  MUTANTS_ARGS: --folder rolling --seed 2 ...
MUTANTS ?= 300
mutants: packages ; @tools/scripts/mutants $(B) --mutants $(MUTANTS) --jobs $(shell nproc) $(MUTANTS_ARGS)

# lines and branches that the tests go through, per folder; what is left in $(B)/coverage/coverage.txt.
# Left out are the tests that look at how the libraries are linked, and those that build by themselves
# (install, release, python, journeys): they would replace objects that count by others.
COVERED ?= covered-tests
UNCOVERED = $(B)/tests/test_symbols $(B)/tests/test_hardening tests/python tests/journeys/%
covered-tests: all page-where-possible $(TESTS) $(B)/packings $(B)/bench/bench_large
	@B=$(B) tests/run $(filter-out $(UNCOVERED),$(LONGEST) $(filter-out $(LONGEST),$(TESTS))) tests/figures
coverage: packages
	@mkdir -p $(B)/coverage
	@$(CC) -O1 -fPIC -c -o $(B)/coverage/exit.o tests/coverage.c
	-@$(MAKE) --no-print-directory B=$(B)/coverage PAGE=$(B)/page CFLAGS="-O0 -g --coverage -fprofile-abs-path -fprofile-update=atomic -DRB_INLINE=static -Wno-unused-function" LDFLAGS="$(CURDIR)/$(B)/coverage/exit.o -Wl,--wrap=_exit,--wrap=kill" $(COVERED)
	@tools/scripts/coverage $(B)/coverage

# what touches most of the library's memory in a minute or two
SHORT = base lcp io_table case api rolling_lcp inside_newton rolling_control rolling_cone rolling_friction threads
short-tests: $(SHORT:%=$(B)/tests/test_%) | $(PROGRAMS)
	@B=$(B) tests/run $^
asan-short:
	@$(MAKE) --no-print-directory $(SANITIZED) short-tests

# every source as .clang-format has it
check-format:
	@! clang-format --dry-run $$(git ls-files '*.c' '*.h') 2>&1 | grep clang-format-violations | cut -d: -f1 | sort -u | sed 's/^/clang-format -i /' | grep .

# friction solvers on published files and on packings of our own
study: packages
	@$(MAKE) --no-print-directory B=$(B) all $(B)/packings $(B)/bench/bench_portfolio $(B)/bench/bench_condense $(B)/bench/bench_friction
	@B=$(B) tools/scripts/friction-study $(PARTS)

bench: packages
	@$(MAKE) --no-print-directory B=$(B) all $(BENCHES)
	@for b in $(BENCHES); do $$b || exit 1; done

$(B)/librollbem.a: $(LIB_OBJ)
	@rm -f $@
	@echo "  AR  $@"
	$(Q)$(AR) rcs $@ $^

$(B)/librollbem.so: $(LIB_OBJ)
	@echo "  LD  $@"
	$(Q)$(CC) $(CFLAGS) $(HARDEN_SO) -shared -Wl,-soname,librollbem.so.0 -o $@ $^ $(LDFLAGS) $(LDLIBS)

# of these objects and libraries
link_with = $(CC) $(CFLAGS) $(HARDEN_LD) -o $@ $(1) $(B)/librollbem.a $(LDFLAGS) $(3) $(2)
link_program = $(if $(ARCHIVES),$(call link_with,$(1),$(2),$(PROGRAM_LIBS)) 2>/dev/null ||) $(call link_with,$(1),$(2),$(LDLIBS))

$(B)/rollbem: $(CLI_OBJ) $(B)/librollbem.a
	@echo "  LD  $@"
	$(Q)$(call link_program,$(CLI_OBJ),)

$(B)/rollbem-mpi: $(MPI_OBJ) $(B)/librollbem.a
	@echo "  LD  $@"
	$(Q)$(call link_program,$(MPI_OBJ),$(shell pkg-config --libs $(MPI)))

# the generator of the friction problems of examples/packings, for the tests and the study
$(B)/packings: examples/packings/packings.c
	@mkdir -p $(@D)
	@echo "  CC  $<"
	$(Q)$(CC) $(STD) $(CFLAGS) -o $@ $< -lm
$(B)/tests/test_friction_portfolio $(B)/tests/test_inside_friction $(B)/tests/test_recorded $(B)/tests/test_course $(B)/bench/bench_condense $(B)/bench/bench_portfolio: | $(B)/packings

# the method in one file, for the tests
$(B)/steps: examples/steps/steps.c
	@mkdir -p $(@D)
	@echo "  CC  $<"
	$(Q)$(CC) $(STD) $(CFLAGS) -o $@ $< $(LDFLAGS) $(LDLIBS)
$(B)/tests/test_steps: | $(B)/steps $(B)/rollbem

# the generator of the obstacle problem, for the tests
$(B)/obstacle: examples/lcp/obstacle.c
	@mkdir -p $(@D)
	@echo "  CC  $<"
	$(Q)$(CC) $(STD) $(CFLAGS) -o $@ $<
$(B)/tests/test_cli_lcp: | $(B)/obstacle

$(B)/src/program/mpi/%.o: CPPFLAGS += $(subst -I,-isystem ,$(shell pkg-config --cflags $(MPI)))

# fused multiply-adds where the instruction set has them: -std=c11 takes them off
$(B)/src/bem/column.o $(B)/bench/bench_bem: private STD += -ffp-contract=fast

# the case files of the examples, for --example
$(B)/examples.inc: $(wildcard examples/*/case.ini)
	@mkdir -p $(@D)
	$(Q)for f in $^; do echo "{\"$$(basename $$(dirname $$f))\","; sed 's/\\/\\\\/g; s/"/\\"/g; s/.*/"&\\n"/' $$f; echo "},"; done > $@
$(B)/src/program/cli/examples.o: $(B)/examples.inc
# the templates of the pictures, line by line
$(B)/pictures.inc: $(wildcard src/program/report/pictures/*.gp)
	@mkdir -p $(@D)
	$(Q)for f in $^; do sed 's/\\/\\\\/g; s/"/\\"/g; s/.*/{"'"$$(basename $$f .gp)"'", "&\\n"},/' $$f; done > $@
$(B)/src/program/report/gnuplot.o: $(B)/pictures.inc
$(B)/src/program/report/gnuplot.o: CPPFLAGS += -I$(B)
$(B)/src/program/cli/example.o $(FEM_OBJ): CPPFLAGS += -Iexamples
# what `rollbem help WORD` finds in the docs
$(B)/words.inc: tools/scripts/words.awk docs/glossary.md docs/faq.md
	@mkdir -p $(@D)
	$(Q)awk -f $^ > $@
$(B)/src/program/cli/find.o: $(B)/words.inc
$(B)/src/program/cli/find.o: CPPFLAGS += -I$(B)
$(B)/src/program/cli/examples.o: CPPFLAGS += -I$(B)

$(B)/%.o: %.c
	@mkdir -p $(@D)
	@echo "  CC  $<"
	$(Q)$(CC) $(STD) $(CFLAGS) $(CPPFLAGS) $(HARDEN) -fPIC -fvisibility=hidden -MMD -MP -c -o $@ $<

# Tests of failing allocations count the library's own calls: --wrap sees the static library.
# Compiling and linking 190 programs takes longer than running most of them: hence -O1, objects that
# stay when the library changes, and a linker that needs 0.3 s of processor time for each, not 0.8 s.
TEST_CFLAGS = $(patsubst -O2,-O1,$(patsubst -O3,-O1,$(CFLAGS)))
TEST_LD := $(firstword $(foreach linker,lld gold,$(if $(shell command -v ld.$(linker)),-fuse-ld=$(linker))))
TEST_LIBS = $(LDFLAGS) $(TEST_LD) $(LDLIBS) -lcmocka
WRAP = -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc,--wrap=aligned_alloc
TEST_OBJ = $(TESTS:=.o) $(patsubst %,$(B)/tests/%.o,calls checker differences endurance failing_alloc fault_call)
.SECONDARY: $(TEST_OBJ)
$(B)/tests/%.o: tests/%.c
	@mkdir -p $(@D)
	@echo "  CC  $<"
	$(Q)$(CC) $(STD) $(TEST_CFLAGS) $(CPPFLAGS) -Itests -MMD -MP -c -o $@ $<
$(B)/tests/%: $(B)/tests/%.o $(B)/tests/failing_alloc.o $(B)/librollbem.a
	@echo "  LD  $@"
	$(Q)$(CC) $(TEST_CFLAGS) -o $@ $(filter %.o,$^) $(B)/librollbem.a $(WRAP) $(TEST_LIBS)

# the finite elements of the examples
FEM_TESTS := $(patsubst %,$(B)/tests/test_%,fem fem_examples fem_reports fem_wall inside_fem)
$(FEM_TESTS): $(FEM_OBJ)
$(FEM_TESTS:=.o): CPPFLAGS += -Iexamples

# the core by itself, with the libraries that it needs and no others
CORE := $(patsubst %.c,$(B)/%.o,$(wildcard src/base/*.c src/bem/*.c src/bem/*/*.c $(foreach folder,lemke portfolio proof contact,src/lcp/$(folder)/*.c) src/rolling/*.c src/rolling/*/*.c src/analysis/crack/*.c)) $(B)/src/base/io/table.o $(B)/src/base/io/text.o $(B)/src/base/io/tokens.o
CORE_LIBS = $(filter-out -lgslcblas,$(shell pkg-config --libs openblas lapacke gsl fftw3)) -lfftw3_threads -lm $(OPENMP)
$(B)/librollbem-core.a: $(filter $(CORE),$(LIB_OBJ))
	@rm -f $@
	@echo "  AR  $@"
	$(Q)$(AR) rcs $@ $^
$(B)/tests/test_core: $(B)/tests/test_core.o $(B)/librollbem-core.a
	@echo "  LD  $@"
	$(Q)$(CC) $(TEST_CFLAGS) -o $@ $^ $(LDFLAGS) $(CORE_LIBS) -lcmocka

# the program under failing system calls, and under failing allocations
$(B)/tests/test_symbols $(B)/tests/test_hardening: | $(B)/librollbem.so
$(B)/tests/test_faults: $(B)/tests/fault_call.o $(B)/tests/fault_malloc.so
$(B)/tests/fault_malloc.so: tests/fault_malloc.c tests/fault_malloc.h tests/fault_calls.h
	@mkdir -p $(@D)
	@echo "  CC  $<"
	$(Q)$(CC) $(STD) -O1 -Wall -Wextra -fPIC -shared -o $@ $< -ldl

# the checker of the net shares nothing with the library; whoever builds a test that runs it gets it too
$(B)/tests/test_net $(B)/tests/test_hostile $(B)/tests/test_certificates $(B)/tests/test_random_abilities: | $(B)/tests/checker $(B)/rollbem
$(B)/tests/test_commands: | $(B)/rollbem
$(B)/tests/test_net: | $(B)/tests/differences $(B)/tests/calls
$(B)/tests/calls $(B)/tests/differences: $(B)/tests/%: $(B)/tests/%.o $(B)/librollbem.a
	@echo "  LD  $@"
	$(Q)$(CC) $(TEST_CFLAGS) -o $@ $^ $(TEST_LIBS)
$(B)/tests/checker: $(B)/tests/checker.o
	@echo "  LD  $@"
	$(Q)$(CC) $(TEST_CFLAGS) -o $@ $^ $(LDFLAGS) -ljansson -lm

# fuzz targets: replayed by a test, and given to libFuzzer by make fuzz; they call commands too,
# files that are only read are kept in memory, and HDF5 may work in the same process
FUZZ_WRAP = -Wl,--wrap=fopen,--wrap=rb_io_in_child
FUZZ_OBJ = $(patsubst %.c,$(B)/%.o,$(filter-out tools/fuzz/libfuzzer.c,$(wildcard tools/fuzz/*.c))) $(filter-out %/cli/main.o,$(CLI_OBJ))
$(B)/tests/test_fuzz.o $(B)/tests/test_inside_cli.o: CPPFLAGS += -I.
$(B)/tests/test_fuzz $(B)/tests/test_inside_cli: $(B)/tests/%: $(B)/tests/%.o $(FUZZ_OBJ) $(B)/librollbem.a
	@echo "  LD  $@"
	$(Q)$(CC) $(TEST_CFLAGS) -o $@ $^ $(FUZZ_WRAP) $(TEST_LIBS)
$(B)/fuzzer: $(FUZZ_OBJ) $(B)/tools/fuzz/libfuzzer.o $(B)/librollbem.a
	@echo "  LD  $@"
	$(Q)$(CC) $(CFLAGS) -fsanitize=fuzzer -o $@ $^ $(LDFLAGS) $(FUZZ_WRAP) $(LDLIBS)

# N=20000 cases at the ends of what is accepted, by the program, judged by tests/checker.c
N ?= 20000
hostile: packages
	@$(MAKE) --no-print-directory B=$(B) all $(B)/tests/test_hostile
	@HOSTILE=$(N) B=$(B) OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive $(B)/tests/test_hostile

# kills of studies, memory over many cases
KILLS ?= 1000
CASES ?= 100000
SOLVES ?= 10000
endurance: packages
	@$(MAKE) --no-print-directory B=$(B) all $(B)/tests/endurance
	@tools/scripts/endurance $(B) --kills $(KILLS) --cases $(CASES) --solves $(SOLVES)

# compilers, optimisation, BLAS, threads: the list in docs/validation.md
platforms: packages ; @tools/scripts/platforms $(B) $(PLATFORMS)

# static analysis of src/
analyse: all
	@tools/scripts/analyse $(B)

# compared with where it is installed, never needed
ifneq ($(wildcard /usr/include/siconos/SiconosConfig.h),)
$(B)/bench/bench_lemke $(B)/bench/bench_friction: CPPFLAGS += -DHAVE_SICONOS -isystem /usr/include/siconos -isystem /usr/include/siconos/numerics
$(B)/bench/bench_lemke $(B)/bench/bench_friction: LDLIBS += -lsiconos_numerics
endif

$(B)/bench/%: tools/bench/%.c $(B)/librollbem.a
	@mkdir -p $(@D)
	@echo "  CC  $<"
	$(Q)$(CC) $(STD) $(CFLAGS) $(CPPFLAGS) -MMD -MP -MF $@.d -o $@ $< $(B)/librollbem.a $(LDFLAGS) $(LDLIBS)

# below DESTDIR, in quotes throughout: a folder's name may have spaces
PREFIXED = $(DESTDIR)$(PREFIX)
LIBRARIES = $(DESTDIR)$(LIBDIR)
install: all
	install -d "$(PREFIXED)/bin" "$(LIBRARIES)" "$(PREFIXED)/include/rollbem"
	install -m 755 $(PROGRAMS) "$(PREFIXED)/bin"
	install -m 644 $(B)/librollbem.a "$(LIBRARIES)"
	@# for rollbem page, where it has been built
	if [ -f $(B)/rollbem.html ]; then install -d "$(PREFIXED)/share/rollbem" && install -m 644 $(B)/rollbem.html "$(PREFIXED)/share/rollbem"; fi
	install -m 644 $(B)/librollbem.so "$(LIBRARIES)/librollbem.so.$(VERSION)"
	ln -sf librollbem.so.$(VERSION) "$(LIBRARIES)/librollbem.so.0"
	ln -sf librollbem.so.0 "$(LIBRARIES)/librollbem.so"
	install -m 644 include/rollbem/*.h "$(PREFIXED)/include/rollbem"
	@for i in rollbem.pc:pkgconfig rollbemConfig.cmake:cmake/rollbem rollbemConfigVersion.cmake:cmake/rollbem; do \
	    to="$(LIBDIR)/$${i#*:}"; up=$$(realpath -m --relative-to="$$to" "$(PREFIX)"); install -d "$(DESTDIR)$$to"; \
	    sed -e "s|@UP@|$$up|" -e 's|@VERSION@|$(VERSION)|' -e 's|@LIBS@|$(LDLIBS)|' tools/scripts/$${i%%:*}.in > "$(DESTDIR)$$to/$${i%%:*}" || exit 1; done
	@B=$(B) tools/scripts/install-shared "$(PREFIXED)/share"

# what install and install-python have put there, and folders of ours that this leaves empty
uninstall:
	rm -f "$(PREFIXED)/bin/rollbem" "$(PREFIXED)/bin/rollbem-mpi" "$(LIBRARIES)"/librollbem.a "$(LIBRARIES)"/librollbem.so*
	rm -f "$(LIBRARIES)/pkgconfig/rollbem.pc" "$(LIBRARIES)"/cmake/rollbem/rollbemConfig*.cmake "$(PREFIXED)"/include/rollbem/*.h
	@tools/scripts/install-shared --remove "$(PREFIXED)/share"
	rm -f "$(PREFIXED)/share/rollbem/rollbem.html" "$(PACKAGES_OF_PYTHON)"/*.py "$(PACKAGES_OF_PYTHON)"/*.pyi "$(PACKAGES_OF_PYTHON)/py.typed" "$(PACKAGES_OF_PYTHON)"/__pycache__/*.pyc
	@for i in "$(LIBRARIES)/cmake/rollbem" "$(PREFIXED)/include/rollbem" "$(PREFIXED)/share/rollbem/octave" "$(PREFIXED)/share/rollbem" \
	    "$(PACKAGES_OF_PYTHON)/__pycache__" "$(PACKAGES_OF_PYTHON)"; do [ ! -d "$$i" ] || rmdir "$$i" 2>/dev/null || true; done

# the package for Python beside the library of the system; pip and wheels: python/README.md
PYTHONDIR ?= $(PREFIX)/lib/python3/dist-packages
PACKAGES_OF_PYTHON = $(DESTDIR)$(PYTHONDIR)/rollbem
install-python:
	install -d "$(PACKAGES_OF_PYTHON)"
	install -m 644 python/rollbem/*.py python/rollbem/py.typed "$(PACKAGES_OF_PYTHON)"
	echo 'VERSION = "$(VERSION)"' > "$(PACKAGES_OF_PYTHON)/_version.py"
	@# types for editors, by the package itself, which needs NumPy for it
	ROLLBEM_LIBRARY="$(CURDIR)/$(B)/librollbem.so" PYTHONPATH=python PYTHONDONTWRITEBYTECODE=1 python3 -m rollbem._stubs > "$(PACKAGES_OF_PYTHON)/__init__.pyi" 2>/dev/null || \
	    rm -f "$(PACKAGES_OF_PYTHON)/__init__.pyi"

# what a release is made of, from the last commit; the same bytes whenever and wherever.  The page is in
# it as it is built, for those who have no compiler for it
DIST = $(B)/rollbem-$(VERSION).tar.gz
dist: page-where-possible
	@mkdir -p $(B)
	git archive --prefix=rollbem-$(VERSION)/ $$([ ! -f $(B)/rollbem.html ] || echo --add-file=$(B)/rollbem.html) HEAD | gzip -n9 > $(DIST)
	@echo "  DIST $(DIST)"

# a release is these: tools/scripts/release
release: ; @tools/scripts/packages --install deb page && tools/scripts/release $(B)

# Debian packages in $(B)/deb, from what make dist packs
deb:
	@tools/scripts/packages --install deb page
	@$(MAKE) --no-print-directory B=$(B) dist
	rm -rf $(B)/deb && mkdir $(B)/deb && tar -xzf $(DIST) -C $(B)/deb
	# without what this make was told: its B is another folder there, and the rules clean it
	cd $(B)/deb/rollbem-$(VERSION) && cp -r packaging/debian . && env -u MAKEFLAGS -u B dpkg-buildpackage -us -uc -b >&2
	@ls $(B)/deb/*.deb

# the pictures of docs/course
course: packages
	@$(MAKE) --no-print-directory B=$(B) $(B)/course/.drawn
# once for all who want them; where it fails, the suite's test of the course says so
$(B)/course/.drawn: docs/course/pictures $(B)/rollbem
	@echo "  DRAW $(@D)"
	-$(Q)ROLLBEM=$(B)/rollbem docs/course/pictures $(@D) && touch $@

# the documentation as a site
site:
	@tools/scripts/packages --install site && $(MAKE) --no-print-directory B=$(B) all && tools/scripts/site $(B)

# the page in a browser: one file with the library as WebAssembly, of the sources that web/sources
# names.  No CC and no CFLAGS change it: other builds (make asan) take it from the same PAGE.
PAGE ?= $(B)/page
WASM_CC = clang-14
WASM_TARGET = --target=wasm32-wasi --sysroot=/usr
WASM_FLAGS = $(WASM_TARGET) -std=c11 -D_POSIX_C_SOURCE=200809L -O3 -msimd128 -DRB_TRANSFORMS=0 -Iweb/wasm/include -Iinclude -Isrc -idirafter /usr/include
WASM_EXPORTS = malloc free $(addprefix rb_api_,create create_for free set resolve solve status message option result value word number \
    note array curve pivots newton variable guess stress stress_maxima crack derivatives tolerances input prove)
WASM_WORDS := $(shell sed 's/\#.*//' web/sources)
WASM_SRC := $(filter-out $(patsubst -%,src/%,$(filter -%,$(WASM_WORDS))),$(wildcard $(patsubst %,src/%/*.c,$(filter-out -%,$(WASM_WORDS))) web/wasm/*.c))
WASM_OBJ := $(WASM_SRC:%.c=$(PAGE)/%.o)
# what reads words, writes tables and calls the kernels is small instead of fast: moves take as long
WASM_SMALL = base/io bem/mesh program/api rolling rolling/body rolling/case rolling/study rolling/history rolling/solve rolling/stress rolling/results rolling/notes analysis/sensitivity lcp/proof
$(PAGE)/%.o: %.c Makefile
	@mkdir -p $(@D)
	@echo "  WASM $<"
	$(Q)$(WASM_CC) $(WASM_FLAGS) $(if $(filter $(WASM_SMALL:%=src/%/),$(<D)/),-Oz) -MMD -MP -c -o $@ $<
$(PAGE)/rollbem.wasm: $(WASM_OBJ) web/sources Makefile
	@echo "  LD  $@"
	$(Q)$(WASM_CC) $(WASM_TARGET) -mexec-model=reactor -o $@ $(WASM_OBJ) -lm -Wl,--strip-all -Wl,-z,stack-size=1048576 $(WASM_EXPORTS:%=-Wl,--export=%)
ifeq ($(wildcard rollbem.html),)
$(B)/rollbem.html: $(PAGE)/rollbem.wasm $(wildcard web/*.*) docs/signs.svg include/rollbem/base.h
	@mkdir -p $(@D)
	@node web/build.mjs $@ $<
-include $(WASM_OBJ:.o=.d)
else
# an archive of sources brings the page along, for those without its compiler; without that file it is built
$(B)/rollbem.html: rollbem.html
	@mkdir -p $(@D)
	@cp $< $@
all: $(B)/rollbem.html
endif

page: ; @{ [ -f rollbem.html ] || tools/scripts/packages --install page; } && $(MAKE) --no-print-directory B=$(B) $(B)/rollbem.html
# for the suite, which skips its tests where the tools are absent
page-where-possible:
	@if [ -f rollbem.html ] || missing=$$(tools/scripts/packages page 2>&1); then $(MAKE) --no-print-directory $(if $(Q),-s) B=$(B) $(B)/rollbem.html; \
	else echo "the page is not built: $$missing" | head -1; fi

# what people of several kinds do on their first day; pictures stay in $(B)/journeys
journeys: all
	@ROLLBEM_TEST_TURNS=8 B=$(B) tests/run $(wildcard tests/journeys/*)

# with what the tests of the package need
python-test: ; @tools/scripts/packages --install python && $(MAKE) --no-print-directory B=$(B) all && ROLLBEM_TEST_TURNS=8 B=$(B) tests/run tests/python

# the page's scripts and styles as web/biome.json has them; biome comes from the npm registry
page-format: ; @web/lint $(B) format --write
page-lint: ; @web/lint $(B) ci
page-test: page $(B)/rollbem
	@B=$(B) tests/page

clean: ; rm -rf $(B)

-include $(LIB_OBJ:.o=.d) $(CLI_OBJ:.o=.d) $(MPI_OBJ:.o=.d) $(FUZZ_OBJ:.o=.d) $(TEST_OBJ:.o=.d) $(BENCHES:=.d)
