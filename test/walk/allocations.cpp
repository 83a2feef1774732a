// A program of its own needs an operator new of its own: the counting one of the broad phases' tests.
#include "../broad_phase/allocations.cpp"
