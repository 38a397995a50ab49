#version 460
// The events of a leaf in order: analytic/leaf_lines.cpp, sortKeys(). All sorts are stable.
layout(local_size_x = 64) in;
#include "shared/visibility_buffers.glsl"
#include "shared/visibility_leaf.glsl"

uint item_count = 0u;
bool fits = true;

// Whose an item is: a line's place among four, or an event. Lines keep the numbers of their keys, a byte each, in
// `span`: where they begin, enter, exit and end; 0 and 255 for the cell's top and bottom. One that does not run inside is
// on one side all along: it has kPassesLeft for the left one, or 0, in the place of the middle two.
const uint kOfEvent = 1024u;

/// Returns the number of the key, as far as it is known before they are sorted.
uint addKey(OrderKey key, FineCoordinate y, uint of) {
    bool below = keyLess(frame.top, key), above = keyLess(key, frame.bottom);
    if (!below || !above) return above ? 0u : 255u;
    fits = fits && item_count < kLeafKeyItems;
    if (fits) items[itemAt(item_count++)] = GpuKey(keyTo(key), double[2](y.grid, y.rest), of, 0u);
    return 0u;
}

void collectItems() {
    for (uint i = 0u; i < leaf.lines; ++i) {
        GpuLine line = lines[lineAt(i)];
        OrderKey in0 = keyFrom(line.in0), in1 = keyFrom(line.in1);
        bool inside = keyLess(in0, in1);
        uint span = 0u;
        if (inside) {
            span |= addKey(in0, yOf(pointFrom(line.enter)), 4u * i + 1u) << 8;
            span |= addKey(in1, yOf(pointFrom(line.exit)), 4u * i + 2u) << 16;
        }
        if (line.line_j >= kFirstEdge && (line.side_before < 0 || line.side_after < 0 || inside)) {
            span |= addKey(keyFrom(line.y0), FineCoordinate(line.a[1], 0.0lf), 4u * i);
            span |= addKey(keyFrom(line.y1), FineCoordinate(line.b[1], 0.0lf), 4u * i + 3u) << 24;
        }
        if (!inside) span |= kPassesLeft * uint((keyLess(keyFrom(line.y0), in1) ? line.side_before : line.side_after) < 0);
        lines[lineAt(i)].span = span;
    }
    for (uint e = 0u; e < leaf.events; ++e) {
        GpuEvent event = events[eventAt(e)];
        events[eventAt(e)].slab = addKey(keyFrom(event.key), yOf(pointFrom(event.point)), kOfEvent + e);
    }
    for (uint h = 0u; h < leaf.horizontals; ++h)
        addKey(keyFrom(horizontals[horizontalAt(h)].in0), yOf(pointFrom(horizontals[horizontalAt(h)].enter)), kNoTag);
}

/// Tells a line or an event the number of its key.
void tell(uint of, uint key) {
    if (of < 4u * kLeafLines) lines[lineAt(of >> 2)].span |= key << (8u * (of & 3u));
    if (of >= kOfEvent && of != kNoTag) events[eventAt(of - kOfEvent)].slab = key;
}

OrderKey sortKey(uint i, bool of_events) {
    return of_events ? keyFrom(events[eventAt(i)].key) : keyFrom(items[itemAt(i)].key);
}

/// The order of items, or of events, in words[from ..]; merges of growing runs. Returns where it ended up.
uint sortedOrder(uint count, bool of_events) {
    uint from = kWordItems, to = kWordItems2;
    spent += count + 24u;
    for (uint i = 0u; i < count; ++i) words[wordAt(from + i)] = i;
    for (uint width = 1u; width < count; width *= 2u) {
        uint p = 0u, q = min(width, count), p_end = q, q_end = min(2u * width, count);
        for (uint k = 0u; k < count; ++k, ++spent) {
            uint a = words[wordAt(from + min(p, count - 1u))], b = words[wordAt(from + min(q, count - 1u))];
            bool second = p >= p_end || (q < q_end && keyLess(sortKey(b, of_events), sortKey(a, of_events)));
            words[wordAt(to + k)] = second ? b : a;
            p += second ? 0u : 1u;
            q += second ? 1u : 0u;
            if (p >= p_end && q >= q_end) {  // the next two runs
                p = q_end;
                p_end = min(p + width, count);
                q = p_end;
                q_end = min(q + width, count);
            }
        }
        uint other = from;
        from = to;
        to = other;
    }
    return from;
}

void distinctKeys(uint order) {
    OrderKey last = frame.top;
    keys[keyAt(0u)] = GpuKey(keyTo(last), double[2](frame.cell.min.y, border(0.0lf).rest), 0u, 0u);
    uint count = 1u;
    for (uint i = 0u; i < item_count; ++i) {
        GpuKey item = items[itemAt(words[wordAt(order + i)])];
        if (!keyEqual(keyFrom(item.key), last)) {
            last = keyFrom(item.key);
            if (count < kLeafKeys) keys[keyAt(count)] = item;
            ++count;
        }
        tell(item.of, count - 1u);
    }
    if (count < kLeafKeys)
        keys[keyAt(count)] = GpuKey(keyTo(frame.bottom), double[2](frame.cell.max.y, border(0.0lf).rest), 0u, 0u);
    ++count;
    fits = fits && count <= kLeafKeys;
    leaf.keys = count;
}

/// Events are few and large: their order is applied by following its cycles through one place of its own.
void sortEvents() {
    uint order = sortedOrder(leaf.events, true);
    for (uint i = 0u; i < leaf.events; ++i) {
        uint from = words[wordAt(order + i)];
        if (from == i) continue;
        GpuEvent held = events[eventAt(i)];
        uint at = i;
        while (from != i) {
            events[eventAt(at)] = events[eventAt(from)];
            words[wordAt(order + at)] = at;
            at = from;
            from = words[wordAt(order + at)];
        }
        events[eventAt(at)] = held;
        words[wordAt(order + at)] = at;
    }
}

void sortHorizontals() {
    for (uint i = 1u; i < leaf.horizontals; ++i) {
        GpuLine h = horizontals[horizontalAt(i)];
        uint j = i;
        for (; j > 0u && keyLess(keyFrom(h.in0), keyFrom(horizontals[horizontalAt(j - 1u)].in0)); --j)
            horizontals[horizontalAt(j)] = horizontals[horizontalAt(j - 1u)];
        horizontals[horizontalAt(j)] = h;
    }
}

/// Lines that run inside, by where they enter.
void sortEntries() {
    for (uint i = 0u; i < leaf.lines; ++i) {
        OrderKey in0 = keyFrom(lines[lineAt(i)].in0);
        if (!keyLess(in0, keyFrom(lines[lineAt(i)].in1))) continue;
        uint j = leaf.entries++;
        for (; j > 0u && keyLess(in0, keyFrom(lines[lineAt(words[wordAt(kWordEntry + j - 1u)])].in0)); --j, ++spent)
            words[wordAt(kWordEntry + j)] = words[wordAt(kWordEntry + j - 1u)];
        words[wordAt(kWordEntry + j)] = i;
    }
}

void main() {
    if (!openLeaf()) return;
    collectItems();
    if (fits) distinctKeys(sortedOrder(item_count, false));
    if (!fits) {
        handBack();
    } else {
        sortEvents();
        sortHorizontals();
        sortEntries();
    }
    // What was counted above, and the loops of the other functions.
    spent += 2u * leaf.lines + 4u * leaf.events + item_count + leaf.horizontals * (leaf.horizontals + 2u) + 40u;
    countLoops();
    leaves[leaf_slot] = leaf;
}
