# Tells whether a run is steady: prints "steady", "steady in the mean" or nothing.
#
#   awk -v tolerance=5e-4 -v cycle=0.01 -v blocks=5 -f settled.awk
#
# reads a line for each block of iterations, the last one being the present: means of CL, CD and CM, and the ranges of
# CL and CD in it. The run is steady where neither lift nor drag has changed by more than the tolerance within the last
# block. It is steady in the mean where the means of so many blocks in a row lie within the tolerance, and no block has
# changes of more than `cycle`.

function abs(x) { return x < 0 ? -x : x }

# Returns whether changes of lift and drag are within this share of them. Where there is hardly any lift, that of a thin
# airfoil at an angle of one degree, pi^2 / 90, says what a small change is.
function within(share, of_cl, of_cd) {
    return of_cd <= share * abs(cd[NR]) && of_cl <= share * (abs(cl[NR]) + 0.11)
}

{ cl[NR] = $1; cd[NR] = $2; range_cl[NR] = $4; range_cd[NR] = $5 }

END {
    if (NR && within(tolerance, range_cl[NR], range_cd[NR])) { print "steady"; exit }
    if (NR < blocks) exit
    cl0 = cl1 = cl[NR]; cd0 = cd1 = cd[NR]
    for (i = NR - blocks + 1; i <= NR; ++i) {
        if (!within(cycle, range_cl[i], range_cd[i])) exit
        if (cl[i] < cl0) cl0 = cl[i]
        if (cl[i] > cl1) cl1 = cl[i]
        if (cd[i] < cd0) cd0 = cd[i]
        if (cd[i] > cd1) cd1 = cd[i]
    }
    if (within(tolerance, cl1 - cl0, cd1 - cd0)) print "steady in the mean"
}
