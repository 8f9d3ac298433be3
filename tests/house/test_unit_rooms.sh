#!/usr/bin/env bash
# Unit tests are in folders named like the folders of src/, and each has the name of the file that it tests:
# number/test_big.c for number/big.c. A suffix, as in displacement/test_separate_layer_memory.c, names the question.
# Files at the top test the library as a whole. Lists of tests by name, as in CMakeLists.txt, name existing unit tests.
set -euo pipefail
cd "${SUNDER_SOURCE:?}/tests/unit"
tests=0 wrong=0
while read -r file; do
    room=$(dirname "$file") name=$(basename "$file" .c)
    name=${name#test_}
    tests=$((tests + 1))
    while [[ ! -f ../../src/$room/$name.c && ! -f ../../src/$room/$name.h && $name == *_* ]]; do name=${name%_*}; done
    if [[ ! -f ../../src/$room/$name.c && ! -f ../../src/$room/$name.h ]]; then
        echo "tests/unit/$file does not have the name of a file of src/$room"
        wrong=$((wrong + 1))
    fi
done < <(find . -mindepth 2 -name '*.c' | sed 's|^\./||' | sort)
while read -r name; do
    if [[ ! -f ../$name.c ]]; then
        echo "there is no tests/$name.c, which tests/CMakeLists.txt names"
        wrong=$((wrong + 1))
    fi
done < <(grep -ohE '\bunit/[a-z_0-9/]*\btest_[a-z_0-9]+' ../CMakeLists.txt | sort -u)
((tests > 80)) || { echo "only $tests unit tests were found"; exit 1; }
exit $((wrong > 0))
