/* A library without umat. */
int answer(void) { return 42; }
