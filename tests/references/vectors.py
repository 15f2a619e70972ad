"""Vectors, rotations and linear systems as plain lists, for numbers of any kind. Quaternions are (w, x, y, z)."""


def add(*vectors):
    """Sum."""
    return [sum(parts[1:], parts[0]) for parts in zip(*vectors)]


def sub(a, b):
    """a − b."""
    return [x - y for x, y in zip(a, b)]


def scale(s, a):
    """s a."""
    return [s * x for x in a]


def dot(a, b):
    """a · b."""
    return sum((x * y for x, y in zip(a[1:], b[1:])), a[0] * b[0])


def cross(a, b):
    """a × b."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def apply(m, v):
    """M v."""
    return [dot(row, v) for row in m]


def apply_transposed(m, v):
    """Mᵀ v."""
    return [dot([row[i] for row in m], v) for i in range(len(m[0]))]


def outer_inertia(mass, c):
    """m (|c|² 1 − c cᵀ): what a shift of the pole by c adds to an inertia tensor."""
    square = dot(c, c)
    return [[mass * ((square if i == j else 0) - c[i] * c[j]) for j in range(3)] for i in range(3)]


def inverse3(m):
    """Inverse of a 3×3 matrix, by cofactors."""
    columns = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])]
    determinant = dot(m[0], columns[0])
    return [[columns[j][i] / determinant for j in range(3)] for i in range(3)]


def quaternion_product(p, q):
    """p ∘ q."""
    w = p[0] * q[0] - dot(p[1:], q[1:])
    return [w] + add(scale(p[0], q[1:]), scale(q[0], p[1:]), cross(p[1:], q[1:]))


def turn(arithmetic, axis, angle):
    """The unit quaternion of a turn by `angle` about the coordinate axis 0, 1 or 2."""
    half = angle / 2
    q = [arithmetic.cos(half), 0 * angle, 0 * angle, 0 * angle]
    q[1 + axis] = arithmetic.sin(half)
    return q


def unit(arithmetic, q):
    """A vector or quaternion divided by its norm."""
    return scale(1 / arithmetic.sqrt(dot(q, q)), q)


def matrix(q):
    """The rotation matrix of a unit quaternion."""
    w, x, y, z = q
    return [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]


def relative(parent, child):
    """Parentᵀ child: the rotation of the child as the parent sees it."""
    columns = [apply_transposed(parent, [row[j] for row in child]) for j in range(3)]
    return [[columns[j][i] for j in range(3)] for i in range(3)]


def solve_symmetric(m, b):
    """Solution of M x = b by LDLᵀ, for a symmetric positive definite M: rows of which the lower part is read."""
    n = len(b)
    lower, pivots, x = [list(row) for row in m], [], list(b)
    for j in range(n):
        row = lower[j]
        for i in range(j):
            # Rows hold L D until here; `scaled` is L.
            for k in range(i):
                row[i] = row[i] - row[k] * lower[i][k]
        pivot = row[j]
        for k in range(j):
            scaled = row[k] / pivots[k]
            pivot = pivot - row[k] * scaled
            row[k] = scaled
            x[j] = x[j] - scaled * x[k]
        pivots.append(pivot)
    x = [value / pivot for value, pivot in zip(x, pivots)]
    for j in reversed(range(n)):
        for k in range(j):
            x[k] = x[k] - lower[j][k] * x[j]
    return x
