# Uniform levels and adaptive tolerances against the true limit surface of the sample dress.
# Variables: folder, machine
set terminal pngcairo size 1200,900 font "DejaVu Sans,11" background "white"
set output folder . "/tessellation.png"
set datafile separator ","
set datafile commentschars "#"
set multiplot layout 2,2 title "Tessellation of the sample dress\n" . machine noenhanced
set logscale xy
set grid
set key top right
set xlabel "triangles"
uniform = folder . "/tessellation_uniform.csv"
adaptive = folder . "/tessellation_adaptive.csv"
do for [column in "error position_rms_mm normal_rms_deg warp_rms_deg"] {
    set ylabel column eq "error" ? "largest departure, pixels" : column noenhanced
    plot uniform using (column("triangles")):(column(column)) with linespoints pt 7 lw 2 title "uniform", \
         adaptive using (column("triangles")):(column(column)) with linespoints pt 5 lw 2 title "adaptive"
}
unset multiplot
