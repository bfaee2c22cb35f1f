#!/bin/bash
# Stands in for standoff-broker, standoff-particles or standoff-structure in tests of the launcher: the name it is called by
# says for which, FAKE_BROKER, FAKE_PARTICLES or FAKE_STRUCTURE what to play (launch_stage.hpp lists the plays).
name=${0##*/standoff-}
printf '%s\n' "$@" > "$FAKE_STAGE/arguments_$name"
env > "$FAKE_STAGE/environment_$name"
for ((i = 1; i < $#; i++)); do
  if [ "${!i}" = --listen ]; then
    j=$((i + 1))
    address=${!j}
    touch "${address#ipc://}"
  fi
done
begin() { [ "$name" = broker ] && head -n 3 "$FAKE_STAGE/events"; }
wait_forever() {
  begin
  sleep 300 &
  echo $! > "$FAKE_STAGE/pids/$name.child"
  echo $$ > "$FAKE_STAGE/pids/$name"
  while true; do wait; done
}
play=FAKE_${name^^}
case ${!play:-done} in
  done) if [ "$name" = broker ]; then cat "$FAKE_STAGE/events"; fi ;;
  hang) wait_forever ;;
  stubborn)
    trap '' TERM INT
    wait_forever
    ;;
  exit3)
    echo "element 5 turned inside out" >&2
    exit 3
    ;;
  failed)
    begin
    echo '{"event":"failed","origin":"structure","code":3,"reason":"element 7 turned inside out","window":412}'
    exit 4
    ;;
  flood)
    begin
    for ((i = 0; ; i++)); do
      echo '{"event":"sample","name":"particles","time_s":'$i'e-5,"values":{"impulse_Ns":1}}'
      echo '{"event":"sample","name":"structure","time_s":'$i'e-5,"values":{"centre_deflection_m":1}}'
    done
    ;;
esac
