cd /work/main
cmake --build --preset dev --target catena catena-derive make_recording diagnosis_space | tail -1
