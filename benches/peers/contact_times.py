"""The scenes of `--example contact_times` in Siconos (4.4, Debian's python3-siconos): its steps, in its time.

    python3 contact_times.py [ROUNDS] [ANGLE PERIOD Y SLEEVE BIRD]

The five numbers are printed by the example: the start of the bird, and what the woodpecker comes to. Each figure is the
median of whole runs, building the model left out; the loop over steps is in Python, each step is compiled code.
"""

import math
import statistics
import sys
import time

import numpy
from siconos.kernel import (
    LCP,
    FrictionContact,
    Interaction,
    LagrangianLinearTIDS,
    LagrangianLinearTIR,
    MoreauJeanOSI,
    NewtonImpactFrictionNSL,
    NewtonImpactNSL,
    NonSmoothDynamicalSystem,
    TimeDiscretisation,
    TimeStepping,
)

G = 9.81


def simulation(body, interactions, problem, step, span):
    model = NonSmoothDynamicalSystem(0, span)
    model.insertDynamicalSystem(body)
    for interaction in interactions:
        model.link(interaction, body)
    return TimeStepping(model, TimeDiscretisation(0, step), MoreauJeanOSI(0.5), problem), model


def run(simulation, count, seen):
    start = time.perf_counter()
    for _ in range(count):
        simulation.computeOneStep()
        seen(simulation.nextTime())
        simulation.nextStep()
    return time.perf_counter() - start


def ball(step, span=10.0):
    body = LagrangianLinearTIDS([1.0], [0.0], numpy.eye(1))
    body.setFExtPtr(numpy.array([-G]))
    floor = Interaction(NewtonImpactNSL(0.9), LagrangianLinearTIR([[1.0]]))
    stepping, model = simulation(body, [floor], LCP(), step, span)
    return stepping, model, body, floor, round(span / step)


def height(t, e=0.9):
    first = math.sqrt(2 / G)
    if t < first:
        return 1 - G * t * t / 2
    since, speed = first, G * first * e
    while t > since + 2 * speed / G and speed > 1e-12:
        since, speed = since + 2 * speed / G, speed * e
    return (t - since) * (speed - G * (t - since) / 2) if speed > 1e-12 else 0.0


def toy(step, angle, span=0.3):
    r, rm, hm, lm, lg, hs, ls = 0.0025, 0.0031, 0.0058, 0.010, 0.015, 0.020, 0.0201
    sleeve, bird, spring, mu = 0.0003, 0.0045, 0.0056, 0.3
    mass = numpy.array([
        [sleeve + bird, bird * lm, bird * lg],
        [bird * lm, 5e-9 + bird * lm**2, bird * lm * lg],
        [bird * lg, bird * lm * lg, 7e-7 + bird * lg**2],
    ])
    stiffness = spring * numpy.array([[0, 0, 0], [0, 1, -1], [0, -1, 1.0]])
    body = LagrangianLinearTIDS([0, -0.0006 / hm, angle], [0, 0, 0], mass, stiffness, numpy.zeros((3, 3)))
    body.setFExtPtr(-G * numpy.array([sleeve + bird, bird * lm, bird * lg]))
    rows = [
        ([[0, 0, -hs], [1, lm, lg - ls]], lm + lg - ls - r, 0.5),
        ([[0, hm, 0], [1, rm, 0]], rm - r, 0.0),
        ([[0, -hm, 0], [1, rm, 0]], rm - r, 0.0),
    ]
    contacts = [
        Interaction(NewtonImpactFrictionNSL(e, 0.0, mu, 2), LagrangianLinearTIR(w, [gap, 0.0])) for w, gap, e in rows
    ]
    stepping, model = simulation(body, contacts, FrictionContact(2), step, span)
    return stepping, model, body, contacts[0], round(span / step)


def report(name, step, span, make, errors, rounds):
    seconds = []
    for _ in range(rounds):
        stepping, *_rest, count = keep = make(step)
        seconds.append(run(stepping, count, lambda t: None))
        del keep
    middle = statistics.median(seconds) * 1e6 / span
    print(f"{name}, steps of {step:g} s: {middle:.0f} µs per simulated second, {errors}")


def main():
    numbers = [float(x) for x in sys.argv[1:]]
    rounds = int(numbers[0]) if numbers else 5
    for step in [0.005, 0.0005]:
        stepping, _model, body, _floor, count = ball(step)
        off = []
        run(stepping, count, lambda t: off.append(abs(body.q()[0] - height(t))))
        report("ball", step, 10.0, ball, f"largest error of the height {max(off):.1e} m", rounds)
    if len(numbers) < 6:
        return
    angle, period, *end = numbers[1:6]
    for step in [2e-5, 2e-6]:
        stepping, _model, body, beak, count = toy(step, angle)
        pecks, struck = [], [False]

        def seen(t):
            strikes = beak.lambda_(1)[0] > 0
            if strikes and not struck[0]:
                pecks.append(t)
            struck[0] = strikes

        run(stepping, count, seen)
        off = max(abs(a - b) for a, b in zip(body.q(), end))
        errors = f"error of the end {off:.1e}, of the period {abs(pecks[1] - pecks[0] - period):.1e} s"
        report("woodpecker", step, 0.3, lambda step: toy(step, angle), errors, max(1, rounds // 5))


main()
