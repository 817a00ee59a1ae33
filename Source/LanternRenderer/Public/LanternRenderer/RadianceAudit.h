// How wrong radiance cells are: what paths find that are followed although a cell has answered (r.RT.GI.Residual).
#pragma once

#include <cstdint>

namespace Lantern
{

/// Sums over such paths, whose luminances have the weight that the pixel takes of them. Sums of different paths may be added and subtracted.
struct FRadianceAuditSums
{
	double Paths = 0.0;
	double Answered = 0.0, Followed = 0.0; ///< of what cells said, and of what paths have found in its place
	double AnsweredSquared = 0.0, FollowedSquared = 0.0, Product = 0.0;

	void Add(double InAnswered, double InFollowed);
	FRadianceAuditSums& operator+=(const FRadianceAuditSums& Other);
	FRadianceAuditSums& operator-=(const FRadianceAuditSums& Other);
	/// Returns the light of whole paths over that of answers: above 1, these are too dark. 1 if they have none.
	double GetRatio() const;
	/// Returns the standard error of the ratio. 0 if there are fewer than two paths, or answers have no light.
	double GetStandardError() const;
};

/// Sums over all frames that have arrived, by what has answered. A frame's paths arrive two frames later, or with WaitForAll. Subtract an
/// earlier audit to leave out frames in which cells were new.
struct FRadianceAudit
{
	FRadianceAuditSums Cells;  ///< the cell of the place
	FRadianceAuditSums Leaves; ///< a cell without a side, which leaves share
	FRadianceAuditSums Coarse; ///< a coarse cell that stands in
	FRadianceAuditSums Lost;   ///< none, and the path had met enough surfaces: frames have nothing of what lies behind
	uint32_t Frames = 0;

	FRadianceAuditSums GetAll() const;
	FRadianceAudit& operator-=(const FRadianceAudit& Earlier);
};

} // namespace Lantern
