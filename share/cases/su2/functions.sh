# What Allrun does with SU2. It sets the variables that are used here.

fail() { echo "Allrun: $*" >&2; exit 1; }

# require: ends the run where SU2 is missing, or where results are in the way.
require() {
    command -v SU2_CFD >/dev/null || fail "SU2_CFD is not in PATH"
    [ ! -e result.json ] && [ ! -e history.csv ] || fail "there are results already: ./Allclean removes them"
}

# run_su2: runs SU2 on run.cfg.
run_su2() {
    if [ "$processes" -gt 1 ]; then
        mpirun -n "$processes" SU2_CFD run.cfg
    else
        SU2_CFD run.cfg
    fi >>log.SU2_CFD 2>&1
}

# y_plus FILE: prints for each wall its name, and the largest and the mean y+ of its vertices in this file of the walls.
# SU2 takes the distance to the next vertex, which is the height of the first cell.
y_plus() {
    awk -v walls="$walls" '
        BEGIN {
            count = split(walls, names)
            for (i = 1; i <= count; ++i) is_wall[names[i]] = 1
        }
        FNR == 1 { ++file }
        file == 1 && /^MARKER_TAG=/ { sub(/^MARKER_TAG= */, ""); name = $1; next }
        file == 1 && /^MARKER_ELEMS=/ { next }
        file == 1 && /^[A-Z]/ { name = "" }
        file == 1 && (name in is_wall) { wall[$2] = wall[$3] = name }
        file == 1 { next }
        FNR == 1 {
            gsub(/[" ]/, "")
            column_count = split($0, header, ",")
            for (i = 1; i <= column_count; ++i) if (header[i] == "Y_Plus") column = i
            next
        }
        {
            split($0, value, ",")
            name = wall[value[1] + 0]
            y = value[column] + 0
            if (y > most[name]) most[name] = y
            sum[name] += y
            ++vertices[name]
        }
        END { for (i = 1; i <= count; ++i) if (vertices[names[i]])
            print names[i], most[names[i]], sum[names[i]] / vertices[names[i]] }
    ' mesh.su2 "$1"
}
