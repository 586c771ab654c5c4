# Prints what a run has come to, and writes the same into result.json.
#
#   awk -v state="steady" -v iterations=N -v cl=CL -v cd=CD -v cm=CM -v range_cl=R -v range_cd=R -f summary.awk
#
# reads a line for each wall: its name, and the largest and the mean y+ of its first cells, at their tops. The state is
# what settled.awk printed.

{ name[++n] = $1; most[n] = $2; mean[n] = $3 }

END {
    json = "result.json"
    printf "{\n  \"steady\": %s,\n", (state == "steady" ? "true" : "false") >json
    printf "  \"steady_in_the_mean\": %s,\n", (state == "" ? "false" : "true") >json
    printf "  \"iterations\": %d,\n", iterations >json
    printf "  \"CL\": %.8g,\n  \"CD\": %.8g,\n  \"CM\": %.8g,\n", cl, cd, cm >json
    printf "  \"range_CL\": %.3g,\n  \"range_CD\": %.3g,\n  \"y_plus\": {", range_cl, range_cd >json
    for (i = 1; i <= n; ++i)
        printf "%s\n    \"%s\": {\"largest\": %.4g, \"mean\": %.4g}", (i == 1 ? "" : ","), name[i], most[i],
            mean[i] >json
    printf "\n  }\n}\n" >json
    print ""
    print (state == "" ? "NOT STEADY" : state) " after " iterations " iterations"
    printf "  %-24s %10.5f\n  %-24s %10.6f\n  %-24s %10.5f\n", "CL", cl, "CD", cd, "CM at quarter chord", cm
    for (i = 1; i <= n; ++i) printf "  %-24s %10.3f   mean %.3f\n", "largest y+, " name[i], most[i], mean[i]
}
