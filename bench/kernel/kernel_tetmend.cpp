// SPDX-License-Identifier: MIT
#include "bench/kernel/tetmend_kernel.h"

int main(int argc, char** argv) {
  return tetmend::bench::run<tetmend::bench::TetmendKernel<false>>(argc, argv);
}
