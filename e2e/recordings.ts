/** A file to give to the page. */
export type Recording = { name: string; text: string };

type Place = readonly [number, number, number];

const STARTS: Record<string, Place> = { red: [0, -0.1, 0.02], yellow: [0, 0.1, 0.02] };
const GOALS: Record<string, Place> = { red: [0.3, 0, 0.02], yellow: [0.3, 0, 0.06] };
const OBJECTS = Object.keys(STARTS);

/** A recording at 20 Hz in which things are carried to their places, in this order, and rest there. */
export function recording(name: string, order: string[], seed = 1): Recording {
  const random = generator(seed);
  const shift = () => 0.04 * (random() - 0.5);
  const places = new Map(OBJECTS.map((object) => [object, STARTS[object].map((value) => value + shift())]));
  const lines = [OBJECTS.flatMap((object) => ["x", "y", "z"].map((axis) => `${object}.${axis}`)).join(",")];
  const frames = (count: number) => {
    for (let frame = 0; frame < count; frame++) {
      const values = OBJECTS.flatMap((object) => places.get(object)!);
      lines.push(values.map((value) => (value + 0.001 * (random() - 0.5)).toFixed(5)).join(","));
    }
  };
  frames(20);
  for (const object of order) {
    const from = [...places.get(object)!];
    for (let step = 1; step <= 30; step++) {
      const share = step / 30;
      const lift = [0, 0, 0.1 * Math.sin(Math.PI * share)];
      places.set(object, from.map((value, axis) => value + (GOALS[object][axis] - value) * share + lift[axis]));
      frames(1);
    }
    frames(24);
  }
  return { name, text: lines.join("\n") + "\n" };
}

/** Three recordings, two of them in the same order. */
export function threeRecordings(): Recording[] {
  return [
    recording("a.csv", ["red", "yellow"], 1),
    recording("b.csv", ["red", "yellow"], 2),
    recording("c.csv", ["yellow", "red"], 3),
  ];
}

/** A recording in which one thing rests at four places, for `frames` frames at each. */
export function restingRecording(name: string, frames: number, seed: number): Recording {
  const random = generator(seed + 1);
  const tremble = () => 0.002 * (random() + random() - 1);
  const shift = () => 0.02 * (random() - 0.5);
  const places = [[0, 0, 0.02], [0.2, 0.1, 0.02], [0.3, -0.1, 0.02], [0.1, -0.2, 0.02]].map(([x, y, z]) => [x + shift(), y + shift(), z]);
  const lines = ["red.x,red.y,red.z"];
  const frame = (point: number[]) => lines.push(point.map((value) => (value + tremble()).toFixed(5)).join(","));
  places.forEach((place, index) => {
    for (let count = 0; count < frames; count++) frame(place);
    const next = places[index + 1];
    for (let step = 1; next && step < 30; step++) {
      const lift = 0.1 * Math.sin((Math.PI * step) / 30);
      frame(place.map((value, axis) => value + ((next[axis] - value) * step) / 30 + (axis === 2 ? lift : 0)));
    }
  });
  return { name, text: lines.join("\n") + "\n" };
}

/** A small generator of numbers from 0 to 1 (mulberry32): the same seed gives the same recording. */
function generator(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** The recording with its last frames many times over. */
export function repeated({ name, text }: Recording, times: number): Recording {
  const [header, ...frames] = text.trimEnd().split("\n");
  return { name, text: [header, ...frames, ...Array.from({ length: times }, () => frames.slice(-20)).flat()].join("\n") + "\n" };
}
