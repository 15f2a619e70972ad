/* The start of a Cortex-M4, and a console through the debugger's port (semihosting). */
#include "board.h"

extern unsigned top_of_stack;
int main(void);
void reset(void);

/* Semihosting, as Arm defines it: the operation in r0, its argument in r1. */
static int host(int operation, const void *argument)
{
    register int r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

void board_print(const char *text)
{
    (void)host(4, text);
}

void reset(void)
{
    /* Coprocessors 10 and 11, the unit for floats, are off after a reset. */
    *(volatile unsigned *)0xe000ed88u |= 0xfu << 20;
    __asm__ volatile("dsb\n isb");
    (void)main();
    (void)host(0x18, (const void *)0x20026);
    for (;;) {
    }
}

__attribute__((section(".vectors"), used)) static const void *const vectors[] = {&top_of_stack, (const void *)reset};
