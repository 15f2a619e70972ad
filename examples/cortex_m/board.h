#ifndef BOARD_H
#define BOARD_H

/* Prints a text on the console of the host. */
void board_print(const char *text);

#endif
