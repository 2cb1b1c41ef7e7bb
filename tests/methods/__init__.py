"""The methods on paper: superposition, virtual work, members, drawings, reports."""
