# SPDX-License-Identifier: Apache-2.0
# Short names for the scripts in tools/.
.PHONY: demo studio test bench format check

demo studio test bench format check:
	@tools/$@
