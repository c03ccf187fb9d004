# Pictures of what tests/bench/run measures of the goniometer, from the CSV files in `folder`:
# goniometer-time.svg and goniometer-settling.svg. `machine` is written above the first.
set encoding utf8
set datafile separator ","
set datafile commentschars "#"
set grid
file(name) = folder . "/goniometer_" . name . ".csv"

set terminal svg size 1000,420 font 'DejaVu Sans,12' background 'white'
set output folder . "/goniometer-time.svg"
set multiplot layout 1,2 title machine noenhanced
set logscale xy
set key top right
set xlabel 'processor time of all cores, s'
set ylabel 'error of brdf × cos θ_r, %'
set title 'Error against run time, black polyester satin'
plot file("photons") using (column("cpu_ms")/1000):(column("error")) with linespoints pt 7 lw 2 \
         lc rgb '#4662d7' title 'against a long run', \
     "" using (column("cpu_ms")/1000):(column("noise")) with lines lw 2 dt 2 lc rgb 'black' \
         title 'told by the standard errors'
set ylabel 'error of the reflected energy, %'
set title 'Error of the reflected energy'
plot file("photons") using (column("cpu_ms")/1000):(abs(column("albedo_error"))) with linespoints \
         pt 7 lw 2 lc rgb '#4662d7' title 'against a long run', \
     "" using (column("cpu_ms")/1000):(column("albedo_noise")) with lines lw 2 dt 2 lc rgb 'black' \
         title 'told by the standard errors'
unset multiplot

set terminal svg size 1000,1080 font 'DejaVu Sans,12' background 'white'
set output folder . "/goniometer-settling.svg"
set multiplot layout 3,2
set mxtics 1
set mytics 1
set ylabel 'error, %'
set yrange [0.02:50]
# panel(NAME), and a line at the value that is used
panel(name) = sprintf("plot file('%s') using 1:(column('error')) with linespoints pt 7 lw 2 lc rgb '#4662d7' title 'brdf × cos θ_r', '' using 1:(column('noise')) with lines lw 2 dt 2 lc rgb '#4662d7' title 'its noise', '' using 1:(abs(column('albedo_error'))) with linespoints pt 5 lw 2 lc rgb '#e06a00' title 'reflected energy', '' using 1:(column('albedo_noise')) with lines lw 2 dt 2 lc rgb '#e06a00' title 'its noise'", name)
used(x) = sprintf("set arrow 1 from first %g, graph 0 to first %g, graph 1 nohead dt 3 lw 2 lc rgb '#808080' back", x, x)
set title 'Division of filaments (used: 20; of others than round 100)'
set xlabel 'turn of the axis from cone to cone, mrad'
eval used(20)
eval panel("turn_per_segment")
set key off
set title 'Points of a yarn path (used: 12)'
set xlabel 'points per crossing'
eval used(12)
eval panel("points_per_crossing")
set title 'Section of triangular filaments (used: 24)'
set xlabel 'points of the section'
eval used(24)
eval panel("section_points")
set title 'Reflections followed, transmission 0.6 (used: all)'
set xlabel 'reflections after the first'
unset arrow 1
eval panel("max_bounces")
set title 'Energy below which photons play Russian roulette (used: 0.5)'
set xlabel 'energy bound, thousandths'
eval used(500)
eval panel("energy_bound")
set title 'The same: what the bound is for'
set ylabel 'noise² × processor time, of that at 1'
set yrange [*:*]
unset logscale y
stats file("energy_bound") using (column("noise")**2*column("cpu_ms")) every ::5::5 nooutput
plot file("energy_bound") using 1:(column("noise")**2*column("cpu_ms")/STATS_max) with linespoints \
    pt 7 lw 2 lc rgb '#4662d7'
unset multiplot
