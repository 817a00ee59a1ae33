// Marks threads whose slots a round updates; Order.comp lists them. Included behind RadianceCellSlots.glsl.

const uint MarkedWords = GROUP_SIZE / 32u;
shared uint Marked[MarkedWords];

// Turn: another one for each time that a cell is asked for.
bool IsTakenByChance(FRadianceGrid Grid, FRadianceCell Cell, uint Turn, float Share)
{
	return float(HashPcg(RadianceSeed(Grid, Cell) ^ HashPcg(Turn)) >> 8u) * (1.0 / 16777216.0) < Share;
}

// All threads of a work group call it once.
void MarkSlot(FRadianceGrid Grid, bool bListed)
{
	uint Lane = gl_LocalInvocationIndex;
	if (Lane < MarkedWords) { Marked[Lane] = 0u; }
	barrier();
	if (bListed) { atomicOr(Marked[Lane >> 5u], 1u << (Lane & 31u)); }
	barrier();
	if (Lane < MarkedWords) { FRadianceWordRef(Grid.Marks).Data[(GetThread() - Lane) / 32u + Lane] = Marked[Lane]; }
}
