"""Pictures of runs by matplotlib, which nothing else needs."""


#: Lines that a legend names.
MOST = 8


def plot(run, names, panels):
    """Panels above one another, each with a line for each of its columns; returns their axes."""
    try:
        from matplotlib import pyplot
    except ImportError:
        raise ImportError("run.plot draws with matplotlib, which is not there: pip install matplotlib") from None
    panels = [[panel] if isinstance(panel, str) else list(panel) for panel in names or panels]
    for name in (name for panel in panels for name in panel):
        if name not in run:
            raise KeyError(f"the run has no column {name}; it has {', '.join(run.columns)}")
    if not all(panels):
        raise ValueError("a panel has no columns")
    _, axes = pyplot.subplots(
        len(panels), 1, sharex=True, squeeze=False, figsize=(8, 1 + 1.8 * len(panels)), layout="constrained"
    )
    axes = axes[:, 0]
    # Between samples nothing is drawn but straight lines: where these are few, the samples are seen.
    mark = "." if len(run) < 200 else None
    for own, panel in zip(axes, panels):
        for place, name in enumerate(panel):
            # A legend that is longer than its panel would push the others aside.
            shown = name if place < MOST else f"and {len(panel) - MOST} more" if place == MOST else None
            own.plot(run.t, run[name], marker=mark, markersize=3, linewidth=1, label=shown)
        for event in run.contact_events:
            own.axvline(event.t, color="0.8", linewidth=0.6, zorder=0)
        own.grid(True, color="0.92")
        own.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize="small")
        own.margins(x=0)
    axes[-1].set_xlabel("t (s)")
    return axes
