# Turns the pressure of an incompressible flow, over the density and counted from that of the free stream, into the
# pressure of a gas whose density is 1 upstream.
#
#   awk -v pressure=P -f compress.awk TIME/p > p
#
# P is the pressure of the free stream. Where the flow is not yet steady the pressure may be below any that a gas can
# have; it becomes no less than a fifth of P.

function of_gas(p) { return p + pressure > pressure / 5 ? p + pressure : pressure / 5 }

$1 == "dimensions" { print "dimensions      [1 -1 -2 0 0 0 0];"; next }

# A list: its length and "(" stand on lines of their own.
/nonuniform/ { in_list = 1 }
in_list && $1 == "(" { in_values = 1; print; next }
in_values && /^\)/ { in_list = in_values = 0 }
in_values { printf "%.12g\n", of_gas($1); next }
$2 == "uniform" { value = $3; sub(/;/, "", value); printf "%s uniform %.12g;\n", $1, of_gas(value); next }
{ print }
