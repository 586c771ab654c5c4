# Prints the means of a run in time and how far it swings, and writes the same into result.json.
#
#   awk -v times=N -v steps=S -f unsteady.awk FORCES WALLS
#
# reads a line of FORCES for each step that counts: its time in convective ones, CL, CD and CM. N and S are the number of
# convective times of the whole run, and of the steps in each. WALLS has a line for each wall: its name, and the largest
# and the mean y+ of its first cells, at their tops. The exit code is 1 where a number is not finite.
#
# Lift crosses its mean upwards once in a period. A period of noise is none: lift must come from below the mean by half the
# standard deviation and go as far above it. Less than two periods give no frequency.

function finite(x) { return x ~ /^[-+0-9.e]+$/ }

FNR == 1 { ++file }
file == 1 {
    if (!finite($2) || !finite($3) || !finite($4)) { failed = 1; exit }
    ++n
    t[n] = $1; l[n] = $2; d[n] = $3
    cl += $2; cd += $3; cm += $4
    next
}
{ name[++walls] = $1; most[walls] = $2; mean[walls] = $3 }

# Prints a coefficient's mean, its standard deviation and its range, on both outputs.
function tell(label, key, mean_of, rms, least, largest) {
    printf "  %-24s %10.5f   standard deviation %.5f, from %.5f to %.5f\n", label, mean_of, rms, least, largest
    printf "  \"%s\": %.8g,\n  \"deviation_%s\": %.5g,\n  \"range_%s\": [%.6g, %.6g],\n", key, mean_of, key, rms, key, least,
        largest >json
}

END {
    if (failed || !n) exit 1
    cl /= n; cd /= n; cm /= n
    l0 = l1 = l[1]; d0 = d1 = d[1]
    for (i = 1; i <= n; ++i) {
        vl += (l[i] - cl) ^ 2; vd += (d[i] - cd) ^ 2
        if (l[i] < l0) l0 = l[i]
        if (l[i] > l1) l1 = l[i]
        if (d[i] < d0) d0 = d[i]
        if (d[i] > d1) d1 = d[i]
        if (i > n / 2) { late_l += l[i]; late_d += d[i] } else { early_l += l[i]; early_d += d[i]; ++early }
    }
    vl = sqrt(vl / n); vd = sqrt(vd / n)
    for (i = 2; i <= n; ++i) {
        if (l[i] < cl - vl / 2) low = 1
        if (low && l[i - 1] < cl && l[i] >= cl) at = t[i - 1] + (t[i] - t[i - 1]) * (cl - l[i - 1]) / (l[i] - l[i - 1])
        if (low && l[i] > cl + vl / 2) {
            crossing = at
            if (!periods++) first = crossing
            low = 0
        }
    }
    --periods
    json = "result.json"
    printf "{\n  \"convective_times\": %s,\n  \"steps_per_time\": %d,\n", times, steps >json
    print ""
    print times " convective times of " steps " steps, means of the second half"
    tell("CL", "CL", cl, vl, l0, l1)
    tell("CD", "CD", cd, vd, d0, d1)
    printf "  %-24s %10.5f\n", "CM at quarter chord", cm
    printf "  \"CM\": %.8g,\n", cm >json
    # How much the means still move: between the two halves of what they are taken from.
    printf "  %-24s %10.5f in CL, %.5f in CD\n", "change within it", late_l / (n - early) - early_l / early,
        late_d / (n - early) - early_d / early
    printf "  \"change_CL\": %.4g,\n  \"change_CD\": %.4g,\n", late_l / (n - early) - early_l / early,
        late_d / (n - early) - early_d / early >json
    frequency = "null"
    if (periods > 1) {
        frequency = sprintf("%.5g", periods / (crossing - first))
        printf "  %-24s %10.4f   of %d periods, per chord\n", "Strouhal number", frequency, periods
    } else
        periods = 0
    printf "  \"periods\": %d,\n  \"Strouhal\": %s,\n  \"y_plus\": {", periods, frequency >json
    for (i = 1; i <= walls; ++i) {
        printf "%s\n    \"%s\": {\"largest\": %.4g, \"mean\": %.4g}", (i == 1 ? "" : ","), name[i], most[i], mean[i] >json
        printf "  %-24s %10.3f   mean %.3f\n", "largest y+, " name[i], most[i], mean[i]
    }
    printf "\n  }\n}\n" >json
}
