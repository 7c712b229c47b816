/* MUMPS behind an opaque pointer, for mumps.rs. The structure that MUMPS shares with its caller changes from version to
 * version, so that only its own header may say what it looks like. */

#include <dmumps_c.h>
#include <stdlib.h>

enum { START = -1, FINISH = -2, ANALYSE = 1, FACTORISE = 2, SOLVE = 3 };
/* How MUMPS is told to use Fortran's own MPI communicator, of which the sequential library has one process. */
enum { WORLD = -987654 };

static int run(DMUMPS_STRUC_C *id, int job) {
    id->job = job;
    dmumps_c(id);
    return id->infog[0];
}

/* Numbers of the parameters are those of MUMPS's manual, which count from one. */
static void set(DMUMPS_STRUC_C *id, int parameter, int value) { id->icntl[parameter - 1] = value; }

/* Null where memory or MUMPS failed. `ordering` is ICNTL(7). */
DMUMPS_STRUC_C *seam_new(int ordering) {
    DMUMPS_STRUC_C *id = calloc(1, sizeof *id);
    if (!id) return NULL;
    id->sym = 0;
    id->par = 1;
    id->comm_fortran = WORLD;
    if (run(id, START) < 0) {
        free(id);
        return NULL;
    }
    for (int stream = 1; stream <= 3; stream++) set(id, stream, -1);
    set(id, 4, 0);
    set(id, 7, ordering);
    set(id, 14, 60); /* Room for pivots that are put off, in per cent. */
    return id;
}

void seam_free(DMUMPS_STRUC_C *id) {
    run(id, FINISH);
    free(id);
}

/* Rows and columns count from one. MUMPS keeps the pointers. */
int seam_analyse(DMUMPS_STRUC_C *id, int n, long long entries, int *rows, int *columns, double *values) {
    id->n = n;
    id->nnz = entries;
    id->irn = rows;
    id->jcn = columns;
    id->a = values;
    return run(id, ANALYSE);
}

int seam_factorise(DMUMPS_STRUC_C *id, double *values) {
    id->a = values;
    return run(id, FACTORISE);
}

int seam_solve(DMUMPS_STRUC_C *id, double *x) {
    id->rhs = x;
    return run(id, SOLVE);
}

/* What the manual calls INFOG(2): the detail of the last error. */
int seam_detail(const DMUMPS_STRUC_C *id) { return id->infog[1]; }
