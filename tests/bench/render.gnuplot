# Error against processor time; before: dashed. Variables: folder, before, machine.
set terminal svg size 860,560 font "DejaVu Sans,13" background "white"
set output folder."/render.svg"
set datafile separator ","
set title "Error of the picture against time; dashed: the version of 2026-11-29\n".machine noenhanced
set logscale xy
set xlabel "processor time, s"
set ylabel "mean square of the relative error"
set grid
set format y "%.0e"
set key outside right
scenes = "'direct ggx' 'direct yarn' 'full ggx' 'full yarn' studio dress"
only(scene) = sprintf("< grep '^%s,' ", scene)
plot for [i=1:6] only(word(scenes, i)).before using 3:4 with linespoints dt 2 lc i pt 6 notitle, \
     for [i=1:6] only(word(scenes, i)).folder."/render.csv" using 3:5 with linespoints lw 2 lc i pt 7 title word(scenes, i)
