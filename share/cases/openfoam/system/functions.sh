# What Allrun and Alladjoint do with OpenFOAM's programs. It sets the variables that are used here.

fail() { echo "${0##*/}: $*" >&2; exit 1; }

# require PROGRAM: ends the run where OpenFOAM's program is missing.
require() {
    # Debian's OpenFOAM has no script that sets this variable, and its programs do not start without it.
    [ -n "$WM_PROJECT_DIR" ] || { [ -d /usr/share/openfoam/etc ] && export WM_PROJECT_DIR=/usr/share/openfoam; }
    command -v "$1" >/dev/null || fail "$1 is not in PATH: load OpenFOAM's environment first"
}

# require_new: ends the run where results are in the way.
require_new() { [ ! -d postProcessing ] || fail "there are results already: ./Allclean removes them"; }

# run PROGRAM OPTION...: its output goes to log.PROGRAM
run() { "$@" >"log.$1" 2>&1 || fail "$1 failed: see log.$1"; }

# prepare_mesh: numbers the cells so that neighbours are near each other, with the fields in 0/ where these differ from cell
# to cell, and checks them.
prepare_mesh() {
    if [ -e system/start ]; then run renumberMesh -overwrite; else run renumberMesh -overwrite -constant; fi
    checkMesh -constant >log.checkMesh 2>&1 # its remarks stop nothing
    echo "numberOfSubdomains $processes;" >system/processes
}

# solve LAST INTERVAL: goes on to this iteration, or time, and writes fields after each interval. The solver gets the
# arguments of the variable of this name, if there are any.
solve() {
    printf 'endTime         %s;\nwriteInterval   %s;\n' "$1" "$2" >system/iterations
    if [ "$processes" -gt 1 ]; then
        # The far field is renewed in whole fields, so they are put together after each block.
        run decomposePar -force -latestTime
        mpirun -np "$processes" $solver $arguments -parallel >>log.$solver 2>&1
    else
        $solver $arguments >>log.$solver 2>&1
    fi || fail "$solver failed before $1: see log.$solver"
    [ "$processes" = 1 ] || { run reconstructPar -newTimes && rm -rf processor[0-9]*; }
    [ -d "$1" ] || fail "$solver wrote no fields at $1: see log.$solver"
}

# stream ANGLE: gives the free stream this angle of attack. The far field follows with vortex().
stream() {
    angle=$1
    [ "$angles" = "$angle" ] || echo "angle of attack $angle degrees"
    awk -v speed="$speed" -v alpha="$angle" 'BEGIN {
        alpha *= 3.14159265358979324 / 180
        u = cos(alpha)
        v = sin(alpha)
        printf "streamVelocity  (%.17g %.17g 0);\n", speed * u, speed * v
        printf "dragDirection   (%.17g %.17g 0);\nliftDirection   (%.17g %.17g 0);\n", u, v, -v, u
    }' >system/stream
}

# vortex TIME CL: gives the far field in the fields of this time the vortex of this lift coefficient. Between slip walls
# there is none: with its images it fades fast.
vortex() {
    circulation=$(awk -v cl="$2" -v c="$chord" -v u="$speed" 'BEGIN { printf "%.12g", cl * u * c / 2 }')
    for field in U p; do
        awk -v patches="$far_fields" -v speed="$speed" -v alpha="$angle" -v circulation="$circulation" \
            -v mach="$mach" -v pressure="$pressure" -v x0="$vortex_x" -v y0="$vortex_y" -f system/farField.awk \
            constant/polyMesh/boundary constant/polyMesh/points constant/polyMesh/faces "$1/$field" >"$1/$field.new" &&
            mv "$1/$field.new" "$1/$field" || fail "the far field of $1/$field could not be written"
    done
}

# wall_table TIME SUFFIX: prints pressure, skin friction and y+ at the middle of each face of the walls, the first two
# from fields whose names have this suffix. The coefficients
# count the free stream's dynamic pressure. cf_x and cf_y are the force of the flow on the wall; OpenFOAM's shear stress
# is that of the wall on the flow.
wall_table() {
    echo "wall,x,y,cp,cf_x,cf_y,y_plus"
    for wall in $walls; do
        paste "postProcessing/walls/$1/p$2_$wall.raw" "postProcessing/walls/$1/wallShearStress$2_$wall.raw" \
            "postProcessing/walls/$1/yPlus_$wall.raw" |
            awk -v wall="$wall" -v pressure="$pressure" -v q="$(awk -v u="$speed" 'BEGIN { print u * u / 2 }')" '
                !/^#/ {
                    cp = ($4 - pressure) / q
                    printf "%s,%s,%s,%.8g,%.8g,%.8g,%.5g\n", wall, $1, $2, cp, -$8 / q, -$9 / q, 2 * $14
                }'
    done
}

# y_plus FIRST: prints for each wall its name, and the largest and the mean y+ at the end of the block that began at FIRST.
# OpenFOAM gives y+ at the middle of the first cells; their tops, which --y-plus is about, are at twice of it.
y_plus() {
    awk '!/^#/ { of[$2] = $2 " " 2 * $4 " " 2 * $5 } END { for (wall in of) print of[wall] }' \
        "postProcessing/yPlus/$1/yPlus.dat" | sort
}

# draw: draws history.png where Python has what it takes.
draw() {
    command -v python3 >/dev/null && python3 -c 'import matplotlib' 2>/dev/null || return 0
    python3 plot.py || echo "Allrun: plot.py failed; the numbers above are complete" >&2
}
