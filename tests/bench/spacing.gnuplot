# What the spacing of the fitted views does, from fit.csv and spacing-*.csv in `folder`: spacing.svg.
# `machine` is written above.
set encoding utf8
set datafile separator ","
set datafile commentschars "#"
set grid
set terminal svg size 1000,760 font 'DejaVu Sans,12' background 'white'
set output folder . "/spacing.svg"
set multiplot layout 2,2 title machine noenhanced
set logscale xy
set xlabel 'degrees between views'
set xtics (2.5, 5, 7.5, 10, 15, 20, 30)
set xrange [2.2:48]
degrees = "(column('parameter') / 10)"
line(of, colour) = sprintf("using %s:(column('%s')) with linespoints pt 7 lw 2 lc rgb '%s' title '%s'", degrees, of, colour, of)
models = line('yarn', '#4662d7') . ", '' " . line('half_vector', '#e06a00') . ", '' " . line('takeda', '#3a923a')
set title 'Time of the fit'
set ylabel 'ms'
set yrange [0.01:*]
set key off
plot folder . "/fit.csv" using (column("parameter") / 10):2 with linespoints pt 7 lw 2 lc rgb '#4662d7', \
     "" using (column("parameter") / 10):2:(sprintf("%d views", column("views"))) with labels left offset 0.7,0.5 notitle
set xrange [2.2:34]
set ylabel 'l2_cos' noenhanced
set yrange [0.01:5]
set key top right noenhanced horizontal maxrows 2 samplen 3
set title 'Made-up satin, light at 45°'
eval "plot folder . '/fit.csv' " . models . ", '' using (column('parameter') / 10):(column('error')) with lines dt 2 lw 2 lc rgb 'black' title 'the surface itself'"
do for [name in "black_polyester_satin polyester_taffeta"] {
    set title 'Traced weave: ' . system("echo " . name . " | tr _ ' '") . ', 15 lights' noenhanced
    eval "plot folder . '/spacing-" . name . ".csv' " . models . ", '' using (column('parameter') / 10):(column('noise')) with lines dt 2 lw 2 lc rgb 'black' title 'noise'"
}
unset multiplot
