D=/work/shared/data
./$1 $D/wean/robotdata1.log - laser_odom 49 $2 $3 $4
./$1 $D/wean/robotdata2.log - laser_odom 49 $2 $3 $4
./$1 $D/radish_raw/intel.clf.bz2 flaser - 49 $2 $3 $4
./$1 $D/radish_raw/aces.clf.bz2 flaser - 49 $2 $3 $4
./$1 $D/jarvis_nav350/jarvis_complex_path_fast.bag $(cat jl) - 29 $2 $3 $4
./$1 $D/mrpt_uwb_laser/log.txt - - 49 $2 $3 $4
./$1 /tmp/kd2/office1.log - - 49 $2 $3 $4
./$1 $D/radish_derived/edmonton.log.gz - - 49 $2 $3 $4
./$1 $D/radish_derived/seattle.log.gz - - 49 $2 $3 $4
