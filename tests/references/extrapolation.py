"""Gragg–Bulirsch–Stoer extrapolation of fixed order with variable steps, for numbers of any precision.

Modified midpoint rule with n = 2, 4, …, 2k substeps; its error has an expansion in squares of the substep (Gragg 1965),
of which Aitken–Neville extrapolation removes k − 1 terms: order 2k. The weights of this sequence grow like (e/2)^(2k),
six digits for k = 22, which the working precision must have to spare.
"""


def step(rates, t, y, derivative, h, k):
    """One step of length h: the state of order 2k, and how far each component is from the state of order 2k − 2."""
    table = []
    for j in range(1, k + 1):
        n = 2 * j
        substep = h / n
        before, now = y, [a + substep * b for a, b in zip(y, derivative)]
        double = 2 * substep
        for m in range(1, n):
            f = rates(t + m * substep, now)
            before, now = now, [a + double * b for a, b in zip(before, f)]
        row = [now]
        for i, previous in enumerate(table):
            # (n_j / n_{j−i−1})² − 1 with n = 2 j.
            p, q = j * j, (j - i - 1) * (j - i - 1)
            row.append([a + (a - b) * q / (p - q) for a, b in zip(row[i], previous)])
        table = row
    return table[-1], [abs(a - b) for a, b in zip(table[-1], table[-2])]


def integrate(rates, y, end, tolerance, k, first):
    """The state at t = end of ẏ = rates(t, y), y(0) = y, and the number of steps.

    `tolerance` bounds, in every step and component, the difference of the two highest orders against max(1, |y|).
    """
    t, h, steps = end * 0, first, 0
    while t < end:
        derivative = rates(t, y)
        last = t + h >= end
        h = end - t if last else h
        new, differences = step(rates, t, y, derivative, h, k)
        error = max(d / max(1, abs(a)) for d, a in zip(differences, new)) / tolerance
        # The difference behaves like h^(2k − 1); double precision suffices for the choice of h.
        factor = min(3.0, 0.85 * max(float(error), 1e-30) ** (-1 / (2 * k - 1)))
        if error <= 1:
            t, y, steps = end if last else t + h, new, steps + 1
        h = h * (int(factor * 1024) or 1) / 1024
    return y, steps
