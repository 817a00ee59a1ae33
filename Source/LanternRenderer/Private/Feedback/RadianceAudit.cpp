// Sums of an audit of radiance cells.
#include "LanternRenderer/RadianceAudit.h"

#include <algorithm>
#include <cmath>

namespace Lantern
{

void FRadianceAuditSums::Add(double InAnswered, double InFollowed)
{
	Paths += 1.0;
	Answered += InAnswered;
	Followed += InFollowed;
	AnsweredSquared += InAnswered * InAnswered;
	FollowedSquared += InFollowed * InFollowed;
	Product += InAnswered * InFollowed;
}

FRadianceAuditSums& FRadianceAuditSums::operator+=(const FRadianceAuditSums& Other)
{
	Paths += Other.Paths;
	Answered += Other.Answered;
	Followed += Other.Followed;
	AnsweredSquared += Other.AnsweredSquared;
	FollowedSquared += Other.FollowedSquared;
	Product += Other.Product;
	return *this;
}

FRadianceAuditSums& FRadianceAuditSums::operator-=(const FRadianceAuditSums& Other)
{
	return *this += {-Other.Paths, -Other.Answered, -Other.Followed, -Other.AnsweredSquared, -Other.FollowedSquared, -Other.Product};
}

double FRadianceAuditSums::GetRatio() const { return Answered > 0.0 ? Followed / Answered : 1.0; }

// That of a ratio of sums: Cochran, "Sampling Techniques" (1977), 6.4.
double FRadianceAuditSums::GetStandardError() const
{
	if (Paths < 2.0 || Answered <= 0.0) { return 0.0; }
	const double Ratio = GetRatio();
	const double Squares = FollowedSquared - 2.0 * Ratio * Product + Ratio * Ratio * AnsweredSquared;
	return std::sqrt(std::max(Squares, 0.0) * Paths / (Paths - 1.0)) / Answered;
}

FRadianceAuditSums FRadianceAudit::GetAll() const
{
	FRadianceAuditSums All = Cells;
	All += Leaves;
	All += Coarse;
	All += Lost;
	return All;
}

FRadianceAudit& FRadianceAudit::operator-=(const FRadianceAudit& Earlier)
{
	Cells -= Earlier.Cells;
	Leaves -= Earlier.Leaves;
	Coarse -= Earlier.Coarse;
	Lost -= Earlier.Lost;
	Frames -= Earlier.Frames;
	return *this;
}

} // namespace Lantern
