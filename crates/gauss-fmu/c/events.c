/* Events of model exchange. A scene without contacts has none. */

static int make_indicators(instance *i, double *indicators)
{
    (void)indicators;
    return make_constants(i);
}

/* Discrete changes at an event: none. */
static int settle(instance *i, int *changed)
{
    (void)i;
    *changed = 0;
    return 1;
}
