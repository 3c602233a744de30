// Cross-checks MCAP with @mcap/core, and CDR with @foxglove/rosmsg2-serialization, both ways: what Cairn writes is
// read by them, checksums and index included, and what they write is read by Cairn.
// usage: node mcap_test.mjs CAIRN
// Exit code 77 (skipped) where these packages are missing.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const [cairn] = process.argv.slice(2);
const require = createRequire(new URL('../../web/package.json', import.meta.url));

function load(name) {
  try {
    return require(name);
  } catch {
    console.log(`skipped: ${name} is not in web/node_modules (npm ci in web/)`);
    return process.exit(77);
  }
}
const { McapIndexedReader, McapStreamReader, McapWriter } = load('@mcap/core');
const { parse } = load('@foxglove/rosmsg');
const { MessageReader, MessageWriter } = load('@foxglove/rosmsg2-serialization');
const zstd = load('@foxglove/wasm-zstd');
const lz4 = load('@foxglove/wasm-lz4');
await zstd.isLoaded;
await lz4.isLoaded;

const decompressHandlers = {
  lz4: (data, size) => lz4(data, Number(size)),
  zstd: (data, size) => zstd.decompress(data, Number(size)),
};

const folder = mkdtempSync(join(tmpdir(), 'cairn_mcap_'));

function run(...words) {
  const result = spawnSync(cairn, words, { cwd: folder, encoding: 'utf8' });
  assert.equal(result.status, 0, result.stderr);
  return result.stdout;
}

class Memory {
  constructor(bytes = new Uint8Array()) { this.bytes = bytes; }
  async size() { return BigInt(this.bytes.length); }
  async read(offset, size) { return this.bytes.slice(Number(offset), Number(offset + size)); }
  position() { return BigInt(this.bytes.length); }
  async write(more) { this.bytes = Buffer.concat([this.bytes, more]); }
}

// All messages of a file by topic, decoded by its own schemas; in the order of the log time.
async function readIndexed(file) {
  const readable = new Memory(readFileSync(join(folder, file)));
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const decoders = new Map();
  const topics = {};
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(message.channelId);
    assert.equal(channel.messageEncoding, 'cdr');
    if (!decoders.has(channel.id)) {
      const schema = reader.schemasById.get(channel.schemaId);
      assert.equal(schema.encoding, 'ros2msg');
      const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
      decoders.set(channel.id, new MessageReader(definition));
    }
    (topics[channel.topic] ??= []).push({ ...message, value: decoders.get(channel.id).readMessage(message.data) });
  }
  return { reader, topics };
}

function countStreamed(file) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(readFileSync(join(folder, file)));
  let messages = 0;
  for (let record; (record = reader.nextRecord());) messages += record.type === 'Message' ? 1 : 0;
  assert(reader.done());
  return messages;
}

const seconds = (time) => time.sec + 1e-9 * (time.nanosec ?? time.nsec);
const yaw = (q) => 2 * Math.atan2(q.z, q.w);

async function checkOurs() {
  run('simulate', 'office', '--duration', '20', '--out', 'office.log');
  run('log', 'convert', 'office.log', 'office.mcap');
  const streams = JSON.parse(run('log', 'info', 'office.log', '--json')).streams;
  const { reader, topics } = await readIndexed('office.mcap');
  assert.equal(reader.header.profile, 'ros2');
  const total = Object.values(topics).reduce((sum, messages) => sum + messages.length, 0);
  assert.equal(Number(reader.statistics.messageCount), total);
  assert.equal(countStreamed('office.mcap'), total);
  streams.forEach((stream, i) => {
    const exact = topics[`/cairn/input/${i}`];
    const ros = topics[`/${stream.name}`];
    assert.equal(exact.length, stream.messages);
    assert.equal(ros.length, stream.messages);
    exact.forEach(({ value, logTime }, k) => {
      assert.equal(logTime, value.arrival);
      assert(Math.abs(seconds(ros[k].value.header.stamp) - Number(value.event_stamp) / 1e9) < 1e-6);
      if (stream.kind === 'odometry') {
        assert.equal(ros[k].value.pose.pose.position.x, value.x);
        assert(Math.abs(Math.sin((yaw(ros[k].value.pose.pose.orientation) - value.theta) / 2)) < 1e-12);
      } else {
        assert.deepEqual(ros[k].value.ranges, value.ranges);
        assert.equal(ros[k].value.angle_min, Math.fround(value.angle_min));
      }
    });
  });
  assert.equal(topics['/tf_static'][0].value.transforms[0].header.frame_id, 'base_link');
}

// A recorded run: poses and tf as the run's own table has them.
async function checkRecording() {
  run('localize', '--map', 'office.map.yaml', '--log', 'office.log', '--init', '1,1.2,0', '--out', 'run');
  const rows = readFileSync(join(folder, 'run/trajectory.tum'), 'utf8').split('\n').filter((line) => /^[0-9]/.test(line));
  const { reader, topics } = await readIndexed('run/run.mcap');
  const metadata = [];
  for await (const record of reader.readMetadata()) metadata.push(record);
  assert.deepEqual(metadata.map((record) => record.name).sort(), ['cairn.end', 'cairn.run']);
  assert.match(metadata.find((record) => record.name === 'cairn.run').metadata.get('configuration'), /recipe: /);
  const exact = topics['/cairn/estimate'];
  assert.equal(exact.length, rows.length);
  rows.forEach((row, k) => {
    const [t, x, y] = row.split(' ').map(Number);
    const pose = topics['/cairn/pose'][k].value;
    assert(Math.abs(seconds(pose.header.stamp) - t) < 1e-6);
    assert.equal(pose.header.frame_id, 'map');
    assert.equal(pose.pose.pose.position.x, exact[k].value.x);
    assert(Math.abs(exact[k].value.x - x) < 1e-5 && Math.abs(exact[k].value.y - y) < 1e-5);
    assert.equal(pose.pose.covariance[0], exact[k].value.covariance_xx);
    assert.equal(pose.pose.covariance[35], exact[k].value.covariance_tt);
  });
  const links = topics['/tf'].map((m) => `${m.value.transforms[0].header.frame_id}->${m.value.transforms[0].child_frame_id}`);
  assert.equal(links.filter((link) => link === 'map->odom').length, rows.length);
  assert(links.includes('odom->base_link'));
  assert.match(run('replay', 'run'), /the same to the last bit/);
}

const header = ['std_msgs/Header', 'builtin_interfaces/Time'];
const definitions = {
  'builtin_interfaces/Time': 'int32 sec\nuint32 nanosec',
  'std_msgs/Header': 'builtin_interfaces/Time stamp\nstring frame_id',
  'geometry_msgs/Vector3': 'float64 x\nfloat64 y\nfloat64 z',
  'geometry_msgs/Quaternion': 'float64 x\nfloat64 y\nfloat64 z\nfloat64 w',
  'geometry_msgs/Transform': 'geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation',
  'geometry_msgs/TransformStamped': 'std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform',
};
const withParts = (fields, parts) =>
  [fields, ...parts.map((part) => `${'='.repeat(80)}\nMSG: ${part}\n${definitions[part]}`)].join('\n');
const types = {
  'sensor_msgs/msg/LaserScan': withParts('std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\n' +
    'float32 angle_increment\nfloat32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\n' +
    'float32[] ranges\nfloat32[] intensities', header),
  'tf2_msgs/msg/TFMessage': withParts('geometry_msgs/TransformStamped[] transforms',
    ['geometry_msgs/TransformStamped', 'geometry_msgs/Transform', 'geometry_msgs/Vector3', 'geometry_msgs/Quaternion', ...header]),
};

const stamp = (k) => ({ sec: 100 + k, nanosec: 500 });
const transform = (k, parent, child, x, theta) => ({
  header: { stamp: stamp(k), frame_id: parent }, child_frame_id: child,
  transform: { translation: { x, y: 0.5, z: 0 }, rotation: { x: 0, y: 0, z: Math.sin(theta / 2), w: Math.cos(theta / 2) } },
});

async function writeTheirs(options) {
  const file = new Memory();
  const writer = new McapWriter({ writable: file, ...options });
  await writer.start({ profile: 'ros2', library: 'the other one' });
  const channels = {};
  for (const [topic, type] of [['/scan', 'sensor_msgs/msg/LaserScan'], ['/tf', 'tf2_msgs/msg/TFMessage']]) {
    const schemaId = await writer.registerSchema({ name: type, encoding: 'ros2msg', data: new TextEncoder().encode(types[type]) });
    const id = await writer.registerChannel({ schemaId, topic, messageEncoding: 'cdr', metadata: new Map() });
    channels[topic] = { id, encode: new MessageWriter(parse(types[type], { ros2: true })) };
  }
  const add = (topic, k, value) => writer.addMessage({
    channelId: channels[topic].id, sequence: k, logTime: BigInt(200 + k) * 1000000000n, publishTime: 0n,
    data: channels[topic].encode.writeMessage(value),
  });
  await add('/tf', 0, { transforms: [transform(0, 'base_link', 'laser', 0.25, 0.125)] });
  for (let k = 0; k < 50; ++k) {
    await add('/tf', k, { transforms: [transform(k, 'odom', 'base_link', 0.1 * k, 0)] });
    const ranges = Float32Array.from({ length: 181 }, (_, i) => 1 + ((i * 7 + k) % 30) / 10);
    await add('/scan', k, { header: { stamp: stamp(k), frame_id: 'laser' }, angle_min: -1.5, angle_max: 1.5,
      angle_increment: 3 / 180, time_increment: 0, scan_time: 0, range_min: 0.1, range_max: 8, ranges, intensities: [] });
  }
  await writer.end();
  return file.bytes;
}

async function checkTheirs(name, options) {
  writeFileSync(join(folder, name), await writeTheirs(options));
  const info = JSON.parse(run('log', 'info', name, '--json'));
  assert.equal(info.format, 'mcap');
  assert.deepEqual(info.warnings, []);
  const [odometry, laser] = info.streams;
  assert.equal(odometry.name, 'tf:odom->base_link');
  assert.equal(odometry.messages, 50);
  assert(Math.abs(odometry.odometry.path_length_m - 4.9) < 1e-9);
  assert.equal(laser.name, '/scan');
  assert.equal(laser.messages, 50);
  assert(Math.abs(laser.start_s - 100.0000005) < 1e-9);
  assert.deepEqual([laser.laser.beams_min, laser.laser.first_angle_rad, laser.laser.range_max_m], [181, -1.5, 8]);
  assert.equal(laser.laser.valid_share, 1);
  assert.equal(laser.T_base_sensor.x_m, 0.25);
  assert(Math.abs(laser.T_base_sensor.theta_rad - 0.125) < 1e-12);
}

const packed = (data) => ({ compression: 'zstd', compressedData: zstd.compress(data) });
try {
  await checkOurs();
  await checkRecording();
  await checkTheirs('plain.mcap', {});
  await checkTheirs('unchunked.mcap', { useChunks: false });
  await checkTheirs('zstd.mcap', { chunkSize: 4000, compressChunk: packed });
  await checkTheirs('bare.mcap', { chunkSize: 4000, compressChunk: packed, useStatistics: false, useSummaryOffsets: false,
    repeatSchemas: false, repeatChannels: false, useMessageIndex: false, useChunkIndex: false });
  writeFileSync(join(folder, 'whole.mcap.zstd'), zstd.compress(await writeTheirs({})));
  assert.equal(JSON.parse(run('log', 'info', 'whole.mcap.zstd', '--json')).messages, 100);
  console.log('MCAP: read theirs, and they ours');
} finally {
  rmSync(folder, { recursive: true });
}
