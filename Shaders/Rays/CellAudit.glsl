// Paths that go on although a radiance cell has answered, or although they have met no cell for too long (AUDITS_CELLS, r.RT.GI.Residual).
// What they find in the end says how wrong answers are, and some correct them: the answer, and the difference over the chance of being
// followed, has the light of whole paths on average.
// WRONG_RESIDUAL: planted fault (r.RT.Debug.GI.ResidualChance).
#ifndef LANTERN_CELL_AUDIT_GLSL
#define LANTERN_CELL_AUDIT_GLSL

#include "../Library/Random.glsl"
#include "../Library/RadianceCells.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer FRadianceAuditRef { FRadianceAuditPath Data[]; };

const uint AuditBounces = 64u; // surfaces that a followed path may meet; Russian roulette ends it before
const uint NoAuditRecord = 0xffffffffu;

struct FCellAudit
{
	// Of the thread.
	uint Record;      // number of what it writes; NoAuditRecord: nothing
	float Correction; // weight of what its paths find beyond the answer
	FRadianceAuditPath First; // what it writes: of its first path that had an answer
	// Of the path.
	float Weight;          // luminance of what the pixel takes of its side's light
	uint Answer;           // RADIANCE_AUDIT_…; RADIANCE_AUDIT_NONE: there was none yet
	vec3 Before, Answered; // what it had brought, and what the cell would have added
};
FCellAudit CellAudit =
    FCellAudit(NoAuditRecord, 0.0, FRadianceAuditPath(RADIANCE_AUDIT_NONE, 0.0, 0.0), 1.0, RADIANCE_AUDIT_NONE, vec3(0.0), vec3(0.0));

// Returns the number of the block of threads that the thread stands for in this frame, or NoAuditRecord. Threads: of the launch.
uint FindAuditRecord(FViewConstants View, uvec2 Thread, uvec2 Threads)
{
	uvec2 Block = Thread * RADIANCE_AUDIT_SIDE / Threads;
	uvec2 First = (Block * Threads + RADIANCE_AUDIT_SIDE - 1u) / RADIANCE_AUDIT_SIDE;
	uvec2 End = ((Block + 1u) * Threads + RADIANCE_AUDIT_SIDE - 1u) / RADIANCE_AUDIT_SIDE;
	uint Number = Block.y * RADIANCE_AUDIT_SIDE + Block.x;
	uvec4 Hash = HashPcg4(uvec4(Number, View.FrameIndex, View.Seed, 0x85ebca6bu));
	return First + Hash.xy % (End - First) == Thread ? Number : NoAuditRecord;
}

// Pixel: the thread's.
void BeginCellAudit(FAddress Grid, FViewConstants View, uvec2 Pixel, uvec2 Thread, uvec2 Threads)
{
	if (Grid == FAddress(0) || FRadianceGridRef(Grid).Data.Audit == FAddress(0)) { return; }
	CellAudit.Record = FindAuditRecord(View, Thread, Threads);
#ifndef SHARED_PATHS // which cannot be negative
	float Chance = FRadianceGridRef(Grid).Data.FollowChance;
	uint Hash = HashPcg(Pixel.x + HashPcg(Pixel.y + HashPcg(View.FrameIndex + HashPcg(View.Seed ^ 0xc2b2ae35u))));
	if (float(Hash >> 8u) * (1.0 / 16777216.0) >= Chance) { return; }
#ifdef WRONG_RESIDUAL
	Chance = 1.0;
#endif
	CellAudit.Correction = 1.0 / Chance;
#endif
}

// Returns whether the path goes on, which had brought Before when a cell answered. Answered: weighted as the path is.
bool GoesOnBehindAnswer(vec3 Before, vec3 Answered)
{
	if (CellAudit.Record == NoAuditRecord && CellAudit.Correction == 0.0) { return false; }
	CellAudit.Answer = RadianceAnswer;
	CellAudit.Before = Before;
	CellAudit.Answered = Answered;
	return true;
}

// Returns what a path counts for that has found Radiance in all. Weight: luminance of what its side takes of it.
vec3 SettleAnswer(vec3 Radiance, float Weight)
{
	uint Answer = CellAudit.Answer;
	if (Answer == RADIANCE_AUDIT_NONE) { return Radiance; }
	CellAudit.Answer = RADIANCE_AUDIT_NONE;
	vec3 Followed = Radiance - CellAudit.Before;
	if (CellAudit.First.Answer == RADIANCE_AUDIT_NONE)
	{
		Weight *= CellAudit.Weight;
		CellAudit.First = FRadianceAuditPath(Answer, Weight * Luminance(CellAudit.Answered), Weight * Luminance(Followed));
	}
	Radiance = CellAudit.Before + CellAudit.Answered;
	return CellAudit.Correction > 0.0 ? Radiance + CellAudit.Correction * (Followed - CellAudit.Answered) : Radiance;
}

void WriteCellAudit(FAddress Grid)
{
	if (CellAudit.Record == NoAuditRecord) { return; }
	FRadianceAuditRef(FRadianceGridRef(Grid).Data.Audit).Data[CellAudit.Record] = CellAudit.First;
}

#endif
