// SPDX-License-Identifier: BSD-3-Clause
//
// Loaded before the system's library (LD_PRELOAD): no thread can be created.
#include <errno.h>
#include <pthread.h>

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                   void* argument) {
  (void)thread, (void)attributes, (void)start, (void)argument;
  return EAGAIN;
}
