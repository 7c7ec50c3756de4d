// Walls in three dimensions: their blocks as they are, to be turned, drawn near, and taken along the load path from rest through the
// collapse. solid.min.js is made of this by build.sh.
import {
  AmbientLight, BufferGeometry, Color, DirectionalLight, DoubleSide, EdgesGeometry, Float32BufferAttribute, Group, LineBasicMaterial,
  LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const MICRO = 1e-6;
const STONE = new Color(0x9aa2aa), STILL = new Color(0xcfc8b8);
// Light to dark, so that it survives a print in grey (ColorBrewer's YlOrRd).
const RAMP = [0xffffcc, 0xfed976, 0xfd8d3c, 0xe31a1c, 0x67000d].map((hex) => new Color(hex));
// What can be coloured: its words, its unit, how many of it make one of the numbers given, and what it is read from.
const MEASURES = {
  movement: { words: "movement of stones", unit: "mm", scale: 1e-3 },
  opening: { words: "opening of joints", unit: "mm", scale: 1e-3, of: 0 },
  slip: { words: "slip of joints", unit: "mm", scale: 1e-3, of: 1 },
  stress: { words: "pressure in joints", unit: "kPa", scale: 1e-3, of: 2 },
};

function colour(share) {
  const at = Math.min(Math.max(share, 0), 1) * (RAMP.length - 1);
  const below = Math.min(Math.floor(at), RAMP.length - 2);
  return RAMP[below].clone().lerp(RAMP[below + 1], at - below);
}

function points(numbers, centroid) {
  const all = [];
  for (let k = 0; k < numbers.length; k += 3) all.push([0, 1, 2].map((axis) => numbers[k + axis] - centroid[axis]));
  return all;
}

// A convex polygon with n corners is a fan of n - 2 triangles.
function fan(corners) {
  return corners.slice(2).flatMap((corner, k) => [corners[0], corners[k + 1], corner]).flat();
}

function geometry(numbers) {
  const own = new BufferGeometry();
  own.setAttribute("position", new Float32BufferAttribute(numbers, 3));
  own.computeVertexNormals();
  return own;
}

// A block about its centroid, with its edges and with the joints that move with it.
function solid(block) {
  const corners = points(block.vertices, block.centroid);
  const faces = block.faces.flatMap((face) => fan(face.map((k) => corners[k])));
  const own = geometry(faces);
  const material = new MeshLambertMaterial({
    color: block.still ? STILL : STONE, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
  });
  const group = new Group();
  group.add(new Mesh(own, material), new LineSegments(new EdgesGeometry(own, 1), new LineBasicMaterial({ color: 0x222222 })));
  return { group, material, centroid: new Vector3().fromArray(block.centroid), still: block.still };
}

function seam(joint, body, block) {
  const corners = fan(points(joint.polygon, block.centroid));
  const material = new MeshBasicMaterial({ side: DoubleSide, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 });
  const mesh = new Mesh(geometry(corners), material);
  body.group.add(mesh);
  return { mesh, material };
}

// A wall with all that is drawn of it.
function built(wall) {
  const bodies = wall.blocks.map(solid);
  const seams = wall.joints.map((joint) => seam(joint, bodies[joint.block], wall.blocks[joint.block]));
  const group = new Group();
  bodies.forEach((body) => group.add(body.group));
  const low = new Vector3(Infinity, Infinity, Infinity), high = low.clone().negate();
  wall.blocks.forEach((block) => points(block.vertices, [0, 0, 0]).forEach((corner) => {
    low.min(new Vector3(...corner));
    high.max(new Vector3(...corner));
  }));
  // States at rest come first; the collapse goes on from the last of them.
  const rested = wall.states.filter((state) => state.rest).length;
  return { wall, bodies, seams, group, low, high, rested };
}

// How far a block has moved (micrometres, microradians) in a state as it is drawn: what it moved at rest is magnified, how it falls is not.
function pose(shown, block, state, times) {
  const own = shown.wall.states[state].poses.slice(6 * block, 6 * block + 6);
  if (shown.rested === 0) return own;
  const last = shown.wall.states[Math.min(state, shown.rested - 1)].poses;
  return own.map((x, k) => x + (times - 1) * last[6 * block + k]);
}

function place(shown, state, times) {
  const gone = new Set(shown.wall.states[state].gone);
  shown.bodies.forEach((body, block) => {
    const [x, y, z, a, b, c] = pose(shown, block, state, times).map((number) => number * MICRO);
    const turn = new Vector3(a, b, c);
    body.group.visible = !gone.has(block);
    body.group.position.copy(body.centroid).add(new Vector3(x, y, z));
    body.group.quaternion.setFromAxisAngle(turn.clone().normalize(), turn.length());
  });
}

// The values that are coloured in a state.
function values(shown, measure, state) {
  const { of } = MEASURES[measure];
  const { poses, joints } = shown.wall.states[state];
  return of === undefined
    ? shown.bodies.map((_, k) => Math.hypot(...poses.slice(6 * k, 6 * k + 3)))
    : shown.seams.map((_, k) => joints[3 * k + of]);
}

// The largest one at the last state at rest, as in the drawing beside: those of a fall would hide all others. Where nothing is seen there, of all.
function largest(shown, measure) {
  const last = shown.rested - 1;
  const most = shown.wall.states.map((_, state) => values(shown, measure, state).reduce((a, b) => Math.max(a, b), 0));
  return (last >= 0 && most[last]) || Math.max(...most);
}

function paint(shown, measure, state, most) {
  const onJoints = measure !== "none" && MEASURES[measure].of !== undefined;
  const own = measure === "none" ? [] : values(shown, measure, state);
  shown.bodies.forEach((body, k) => {
    // Joints lie between stones: to be seen, stones are glass.
    Object.assign(body.material, { transparent: onJoints, opacity: onJoints ? 0.25 : 1, depthWrite: !onJoints });
    body.material.color.copy(measure === "movement" && most > 0 ? colour(own[k] / most) : body.still ? STILL : STONE);
    body.material.needsUpdate = true;
  });
  shown.seams.forEach(({ mesh, material }, k) => {
    mesh.visible = onJoints;
    if (onJoints) material.color.copy(colour(most > 0 ? own[k] / most : 0));
  });
}

function short(x) {
  return x === 0 ? "0" : Number(x.toPrecision(3)).toString();
}

function show(figure) {
  const canvas = figure.querySelector("canvas");
  const control = (name) => figure.querySelector(`[name=${name}]`);
  const [slider, times, measure, which, play] = ["state", "times", "measure", "wall", "play"].map(control);
  const [said, timesSaid, bar] = [".said", ".times", ".bar"].map((name) => figure.querySelector(name));
  let renderer;
  try {
    renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
  } catch {
    figure.querySelector(".without").hidden = false;
    canvas.hidden = true;
    figure.querySelectorAll("input, select, button").forEach((own) => { own.disabled = true; });
    return;
  }
  const walls = JSON.parse(figure.querySelector("script").textContent);
  const scene = new Scene();
  const camera = new PerspectiveCamera(35, 1, 0.01, 1000);
  camera.up.set(0, 0, 1);
  const sun = new DirectionalLight(0xffffff, 2);
  scene.add(new AmbientLight(0xffffff, 1.2), sun);
  const controls = new OrbitControls(camera, canvas);
  // Until it is chosen the wheel goes on through the page.
  controls.enableZoom = false;
  canvas.addEventListener("focus", () => { controls.enableZoom = true; });
  canvas.addEventListener("blur", () => { controls.enableZoom = false; });
  canvas.addEventListener("pointerdown", () => canvas.focus());
  const middle = new Vector3();
  let shown, most = 0, playing = 0;

  // The factor of the slider, which goes by powers: 1 at its left end.
  const factor = () => Math.max(1, Math.pow(shown.wall.magnification * 4, times.valueAsNumber));

  function draw() {
    const width = canvas.clientWidth, height = canvas.clientHeight, state = slider.valueAsNumber;
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(width, height, false);
    renderer.setClearColor(0xffffff);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    place(shown, state, factor());
    paint(shown, measure.value, state, most);
    renderer.render(scene, camera);
    said.textContent = shown.wall.states[state].said;
    slider.setAttribute("aria-valuetext", said.textContent);
    timesSaid.textContent = `times ${short(factor())}`;
    times.setAttribute("aria-valuetext", timesSaid.textContent);
  }

  function chooseMeasure() {
    const own = MEASURES[measure.value];
    most = own ? largest(shown, measure.value) : 0;
    bar.hidden = !own;
    if (own) {
      const sized = shown.wall.is_mechanism && measure.value !== "stress";
      const end = sized ? "most" : `${short(most * own.scale)} ${own.unit} and more`;
      bar.querySelector(".end").textContent = `${end}: ${own.words}${shown.rested > 0 && !sized ? ", largest at the last state at rest" : ""}`;
    }
    draw();
  }

  function choose() {
    if (shown) scene.remove(shown.group);
    shown = built(walls[which ? Number(which.value) : 0]);
    scene.add(shown.group);
    slider.max = shown.wall.states.length - 1;
    slider.value = slider.max;
    times.value = shown.wall.magnification > 1 ? Math.log(shown.wall.magnification) / Math.log(shown.wall.magnification * 4) : 0;
    times.closest("label").hidden = shown.wall.magnification <= 1;
    middle.copy(shown.low).add(shown.high).multiplyScalar(0.5);
    const size = Math.max(shown.low.distanceTo(shown.high), 1e-3);
    const side = shown.wall.from_front ? 1 : -1;
    camera.position.copy(middle).add(new Vector3(-0.6 * side, 1.3 * side, 0.6).multiplyScalar(0.9 * size));
    sun.position.set(-0.3 * side, 1 * side, 1.6);
    controls.target.copy(middle);
    controls.update();
    chooseMeasure();
  }

  function stop() {
    clearInterval(playing);
    playing = 0;
    play.textContent = "Play";
  }

  play.addEventListener("click", () => {
    if (playing) return stop();
    if (slider.valueAsNumber === Number(slider.max)) slider.value = 0;
    play.textContent = "Stop";
    playing = setInterval(() => {
      slider.value = slider.valueAsNumber + 1;
      draw();
      if (slider.valueAsNumber === Number(slider.max)) stop();
    }, 80);
  });
  slider.addEventListener("input", () => { stop(); draw(); });
  times.addEventListener("input", draw);
  measure.addEventListener("change", chooseMeasure);
  if (which) which.addEventListener("change", () => { stop(); choose(); });
  controls.addEventListener("change", draw);
  addEventListener("resize", draw);
  addEventListener("beforeprint", draw);
  canvas.addEventListener("keydown", (event) => {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    const nearer = { "+": 0.9, "-": 1 / 0.9 }[event.key];
    if (!turns && !nearer) return;
    const arm = camera.position.clone().sub(middle);
    if (turns) {
      const flat = Math.hypot(arm.x, arm.y), length = arm.length();
      const about = Math.atan2(arm.y, arm.x) + 0.1 * turns[0];
      const up = Math.min(1.5, Math.max(-0.2, Math.atan2(arm.z, flat) - 0.1 * turns[1]));
      arm.set(Math.cos(about) * Math.cos(up), Math.sin(about) * Math.cos(up), Math.sin(up)).multiplyScalar(length);
    } else {
      arm.multiplyScalar(nearer);
    }
    camera.position.copy(controls.target).add(arm);
    controls.update();
    draw();
    event.preventDefault();
  });
  choose();
}

document.querySelectorAll("figure.solid").forEach(show);
