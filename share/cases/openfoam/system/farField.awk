# Gives each face of the far field the velocity, or the pressure, of the free stream and of a vortex that has the
# lift. A uniform stream, with a far field of 100 chords, costs 0.0011 in the drag coefficient at a lift coefficient of
# 1; the error grows with the square of the lift.
#
#   awk -v patches='NAME ...' -v speed=U -v alpha=DEGREES -v circulation=GAMMA -v mach=M -v pressure=P -v x0=X -v y0=Y \
#       -f farField.awk constant/polyMesh/boundary constant/polyMesh/points constant/polyMesh/faces TIME/U > U
#
# prints the field file with new freestreamValues of the patches. Coordinates of faces are means of their corners.
# Circulation is positive where it lifts: the velocity of the vortex is
#   (y - y0, x0 - x) circulation / (2 pi r^2),  and the pressure (speed^2 - velocity^2) / 2.
# At a Mach number above 0, with b^2 = 1 - mach^2, r^2 becomes (along^2 + b^2 across^2) / b, where along and across are
# the distances in the direction of the stream and across it (Prandtl and Glauert), and the pressure is that of a gas
# with the same entropy as the free stream, whose pressure is P.

BEGIN {
    pi = 3.14159265358979
    alpha *= pi / 180
    file = 0
    count = split(patches, names)
    for (i = 1; i <= count; ++i) is_far[names[i]] = 1
}

FNR == 1 { ++file; in_patch = 0; depth = 0; listed = -1 }

# The ranges of faces of all patches.
file == 1 {
    if (NF == 1 && $1 !~ /^[{}()]/) patch = $1
    if ($1 == "nFaces") faces[patch] = $2 + 0
    if ($1 == "startFace") {
        start[patch] = $2 + 0
        if (patch in is_far)
            for (f = start[patch]; f < start[patch] + faces[patch]; ++f) wanted[f] = 1
    }
    next
}

# A list: entries stand on lines of their own behind a line "(".
file == 2 || file == 3 {
    if (listed < 0) {
        if ($0 == "(") listed = 0
        next
    }
    if ($0 == ")") { listed = -1; next }
    if (file == 2) {
        gsub(/[()]/, " ")
        x[listed] = $1
        y[listed] = $2
    } else if (listed in wanted) {
        sub(/^[0-9]*\(/, "")
        sub(/\)/, "")
        xs = ys = 0
        for (i = 1; i <= NF; ++i) { xs += x[$i]; ys += y[$i] }
        face_x[listed] = xs / NF
        face_y[listed] = ys / NF
    }
    ++listed
    next
}

# The field: everything is copied but the freestreamValues of the patches, which end with the next semicolon.
skipping {
    if ($0 ~ /;/) skipping = 0
    next
}
$1 == "class" { is_vector = $2 ~ /Vector/ }
NF == 1 && ($1 in is_far) { patch = $1; in_patch = 1 }
in_patch && $1 == "}" { in_patch = 0 }
in_patch && $1 == "freestreamValue" {
    skipping = $0 !~ /;/
    print "        freestreamValue nonuniform List<" (is_vector ? "vector" : "scalar") ">"
    print faces[patch] "\n("
    for (f = start[patch]; f < start[patch] + faces[patch]; ++f) {
        dx = face_x[f] - x0
        dy = face_y[f] - y0
        along = dx * cos(alpha) + dy * sin(alpha)
        across = dy * cos(alpha) - dx * sin(alpha)
        b = sqrt(1 - mach * mach)
        vortex = circulation * b / (2 * pi * (along * along + b * b * across * across))
        u = speed * cos(alpha) + dy * vortex
        v = speed * sin(alpha) - dx * vortex
        if (is_vector) printf "(%.12g %.12g 0)\n", u, v
        else if (mach == 0) printf "%.12g\n", (speed * speed - u * u - v * v) / 2
        else printf "%.12g\n", pressure * (1 + 0.2 * mach * mach * (1 - (u * u + v * v) / (speed * speed))) ^ 3.5
    }
    print ")\n;"
    next
}
{ print }
