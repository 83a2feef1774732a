"""A world: ids, filters and the events of an update."""

import abut

WALLS, PLAYERS = 1, 2

world = abut.World2()
door = world.add(abut.Box2((4, 0), (1, 1)), fixed=True, sensor=True, user=77)
world.add(abut.Box2((8, 0), (0.5, 5)), fixed=True, layers=WALLS)
player = world.add(abut.Circle((0, 0), 0.5), layers=PLAYERS)

seen = []
for step in range(8):
    world.move(player, ((float(step), 0),))
    events = world.update()
    for pair in events.began:
        seen.append(("enter", step))
    for pair in events.ended:
        seen.append(("leave", step))
print(seen)
assert seen == [("enter", 3), ("leave", 6), ("enter", 7)]

# The player looks along x, but not at itself. A sensor hides nothing.
hit = world.raycast(abut.Ray2((7, 0), (1, 0), 100), filter={"ignore": player, "mask": WALLS})
print(f"a wall {hit.hit.distance} ahead")
assert hit.hit.distance == 0.5 and world.options(door).user == 77

# Rollback, bit for bit.
snapshot = world.save()
world.remove(player)
world.restore(snapshot)
assert world.contains(player)
